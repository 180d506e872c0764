#pragma once
// The rows of the coupling that feels a copy of tissue. docs/haptics.md says what they are measured against.

#include "bench/haptic/rows.h"
#include "bench/haptic/touch_trials.h"

namespace palpate::bench {

/// Of T1 [Hz].
std::vector<double> touch_frequencies(Effort effort);

// rows_touch.cpp: a led hand
Row sines_are_felt_as_borne(Runs& runs);          // T1
Row lump_of_a_chain_is_seen_through(Runs& runs);  // T1, negative control
Row taps_are_felt_as_borne(Runs& runs);           // T2
Row relaxation_is_felt(Runs& runs);               // T3
Row clear_tip_bears_nothing(Runs& runs);          // T4
Row cuts_are_felt(Runs& runs);                    // T5

// rows_touch_solid.cpp: the same on the product's own elements
Row sines_on_elements_are_felt_as_borne(Runs& runs);   // T1
Row one_mode_of_elements_is_seen_through(Runs& runs);  // T1, negative control
Row taps_on_elements_are_felt_as_borne(Runs& runs);    // T2

// rows_world_truth.cpp: the same with the real library and controller
Row world_tissue_swings(Runs& runs);   // T1
Row world_tissue_taps(Runs& runs);     // T2
Row world_tissue_relaxes(Runs& runs);  // T3

// rows_touch_matrix.cpp: hands that give
Row copy_is_stable(Runs& runs);                     // S2 with it
Row copy_gains_nothing_without_a_hand(Runs& runs);  // S2
Row copy_bears_wrong_models(Runs& runs);            // T6
Row copy_bears_a_wrong_first_touch(Runs& runs);     // T6
Row copy_keeps_energy_with_any_model(Runs& runs);   // T7
Row extrapolated_force_is_unstable(Runs& runs);     // T8
Row pulse_is_felt_by_copy(Runs& runs);              // T9

}  // namespace palpate::bench
