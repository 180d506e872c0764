// The acceptance rows of the haptic loop, with some of their cases: `palpate bench haptic` runs all. docs/haptics.md has
// the figures.

#include "tests/property/acceptance_rows.h"

namespace palpate::bench {
namespace {

INSTANTIATE_TEST_SUITE_P(
    HapticLoop, InAMatrix,
    ::testing::Values(
        std::pair{"NegativeControls", &direct_and_raw_are_unstable}, std::pair{"StaticWall", &wall_is_stable},
        std::pair{"StiffestWall", &stiffest_wall}, std::pair{"TissueThatYields", &matrix_is_stable},
        std::pair{"NoHand", &push_without_a_hand_gains_nothing},
        std::pair{"StiffHandSpring", &stiff_matrix_is_stable},
        std::pair{"UnrulyLinks", &unruly_links_are_borne}, std::pair{"Gaps", &gaps_are_borne},
        std::pair{"RawPlanesOnRealTissue", &world_raw_is_unstable}, std::pair{"RealTissue", &world_is_stable},
        std::pair{"RealWall", &world_wall_is_stable}, std::pair{"PulseOfRealPhysics", &world_pulse_is_felt},
        std::pair{"StiffSpringOnRealTissue", &world_bears_a_stiff_spring},
        std::pair{"UnrulyLinksToRealTissue", &world_bears_unruly_links},
        std::pair{"TrueForceOfRealTissue", &world_force_is_true}, std::pair{"Stick", &stick_is_steady},
        std::pair{"StickWithTorques", &stick_with_torques_is_steady}, std::pair{"TrueForce", &force_is_true},
        std::pair{"Pulse", &pulse_is_felt}),
    by_name);

TEST(HapticLoop, PushesGentlyWhenPlanesTeleport) { expect(teleports_push_gently()); }
TEST(HapticLoop, FeelsEdgesAndCornersAsTheyAre) { expect(edges_and_corners()); }
TEST(HapticLoop, FeelsASphereAsRound) { expect(sphere_is_round()); }
TEST(HapticLoop, MindsNoOtherClock) { expect(clocks_may_differ(quick())); }
TEST(HapticLoop, IsFreeInFreeSpace) { expect(free_space_is_free()); }
TEST(HapticLoop, IsFreeAboveRealTissue) { expect(world_free_space_is_free()); }
TEST(HapticLoop, HoldsItsLimitStill) { expect(saturation_is_quiet()); }
TEST(HapticLoop, HoldsItsLimitStillOnRealPhysics) { expect(world_saturation_is_quiet()); }
TEST(HapticLoop, PushesGentlyWhenRealPhysicsLeaps) { expect(world_teleports_push_gently()); }
TEST(HapticLoop, FeelsNothingBesideARealEdge) { expect(world_edge_has_no_ghost(quick())); }
TEST(HapticLoop, FadesWhenPhysicsDies) { expect(silence_fades()); }
TEST(HapticLoop, BoundsTorques) { expect(torque_is_bounded(quick())); }
TEST(HapticLoop, FadesWhenRealTissueFallsSilent) { expect(world_silence_fades()); }
TEST(HapticLoop, DoesNotKickWhenRealTissueReturns) { expect(world_return_is_no_kick()); }
TEST(HapticLoop, DoesNotKickWhenPhysicsReturns) { expect(return_is_no_kick()); }
TEST(HapticLoop, StopsBadDevices) { expect(bad_devices_are_stopped()); }
TEST(HapticLoop, HasAnExactProxy) { expect(proxy_is_exact(quick())); }
TEST(HapticLoop, CalibratesExactly) { expect(calibration_is_exact(quick())); }
TEST(HapticLoop, BearsRubbish) { expect(rubbish_is_harmless(quick())); }

/// No force and no energy are no merit of a hand that was never armed.
TEST(HapticLoop, IsNotCalledFreeWhereItNeverArms) {
  const Row row = free_space_is_free(1);
  EXPECT_FALSE(row.pass);
  EXPECT_EQ(row.figure.find("0 N, 0 J, "), 0u) << row.figure;
  EXPECT_EQ(row.figure.find(" 0 of "), row.figure.npos) << row.figure;
}

/// The harness must be able to see what is wrong: energy from a spring that comes two ticks late.
TEST(HapticLoop, IsSeenToGainEnergyWithRawPlanes) {
  Case c;
  c.mode = RenderMode::raw_planes;
  c.object = object_models[1];
  const CaseResult r = run_case(c);
  EXPECT_GT(r.surplus, EnergyBook::G_allowed);
  EXPECT_GT(r.swing, 200e-6);
}

TEST(HapticLoop, GivesTheSameBitsForTheSameCase) {
  Case c;
  c.link.loss = 0.1;
  c.link.jitter = 5e-3;
  const CaseResult a = run_case(c), b = run_case(c);
  EXPECT_TRUE(a.felt());
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.swing, b.swing);
  EXPECT_EQ(a.surplus, b.surplus);
}

}  // namespace
}  // namespace palpate::bench
