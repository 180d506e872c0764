// The acceptance rows of tissue that the hand's motion presses and of the copy that is felt, with some of their cases: `palpate bench haptic` runs all.
// docs/haptics.md has the figures.

#include "bench/haptic/rows_surface.h"
#include "bench/haptic/rows_touch.h"
#include "tests/property/acceptance_rows.h"

namespace palpate::bench {
namespace {

INSTANTIATE_TEST_SUITE_P(RealTissue, InAMatrix,
                         ::testing::Values(std::pair{"PressedTissueIsStable", &world_tissue_is_stable},
                                           std::pair{"PressedTissueIsTrue", &world_tissue_is_true},
                                           std::pair{"PressedTissueSlides", &world_tissue_slides},
                                           std::pair{"PressedTissueSwings", &world_tissue_swings},
                                           std::pair{"PressedTissueTaps", &world_tissue_taps},
                                           std::pair{"PressedTissueRelaxes", &world_tissue_relaxes},
                                           std::pair{"PressedTissueBearsAStick",
                                                     &world_tissue_bears_a_stick}),
                         by_name);

INSTANTIATE_TEST_SUITE_P(
    CopyOfTissue, InAMatrix,
    ::testing::Values(std::pair{"Sines", &sines_are_felt_as_borne},
                      std::pair{"LumpOfAChain", &lump_of_a_chain_is_seen_through},
                      std::pair{"SinesOnElements", &sines_on_elements_are_felt_as_borne},
                      std::pair{"OneModeOfElements", &one_mode_of_elements_is_seen_through},
                      std::pair{"TapsOnElements", &taps_on_elements_are_felt_as_borne},
                      std::pair{"Taps", &taps_are_felt_as_borne},
                      std::pair{"Relaxation", &relaxation_is_felt},
                      std::pair{"ClearTip", &clear_tip_bears_nothing}, std::pair{"Cuts", &cuts_are_felt},
                      std::pair{"TissueThatYields", &copy_is_stable},
                      std::pair{"NoHand", &copy_gains_nothing_without_a_hand},
                      std::pair{"WrongModels", &copy_bears_wrong_models},
                      std::pair{"WrongFirstTouch", &copy_bears_a_wrong_first_touch},
                      std::pair{"AnyModel", &copy_keeps_energy_with_any_model},
                      std::pair{"ExtrapolatedForce", &extrapolated_force_is_unstable},
                      std::pair{"Pulse", &pulse_is_felt_by_copy}),
    by_name);

INSTANTIATE_TEST_SUITE_P(CopyOfASurface, InAMatrix,
                         ::testing::Values(std::pair{"Taps", &surface_taps_are_felt_as_borne},
                                           std::pair{"Slides", &slides_are_felt_as_borne},
                                           std::pair{"Frozen", &frozen_surface_is_seen_through},
                                           std::pair{"ModesAlone", &modes_alone_are_seen_through},
                                           std::pair{"Hold", &hold_after_a_slide_is_still},
                                           std::pair{"NoHand", &surface_gives_nothing_to_a_handle}),
                         by_name);

}  // namespace
}  // namespace palpate::bench
