#include "haptic_node/tissue/model_fade.h"

#include <gtest/gtest.h>

#include "tests/unit/haptic_node/tissue/some_tissues.h"

namespace palpate::haptic {
namespace {

constexpr double h = 1e-3;
const Vec3 x = down(3e-3);

/// At rest under a hand that holds still at x.
TissueCopy resting(const TissueModel& model, double rest = 0) {
  TissueCopy copy{TissueStep(model, {500, 1}, h), {}};
  copy.state.rest = down(rest);
  for (int n = 0; n < 20'000; ++n) copy.step.advance(copy.state, {x, Vec3::Zero()});
  return copy;
}

/// Ticks until felt is within 0.05 N of the shadow.
int ticks_to(TissueCopy felt, const TissueCopy& shadow, int alternate = 0) {
  ModelFade fade;
  WorkTank tank;
  TissueCopy above = shadow;
  above.state.force = felt.state.force + down(2 * ModelFade::ripple_force);
  for (int n = 0; n < alternate; ++n) {
    TissueCopy stays = felt;
    fade.pass(stays, above, x, 0.08, tank, 1);
  }
  for (int n = 1; n < 5000; ++n) {
    fade.pass(felt, shadow, x, 1.0, tank, 1);
    if ((felt.state.force - shadow.state.force).norm() < 0.05) return n;
  }
  return 5000;
}

TEST(ModelFade, LeavesWhatIsTheSame) {
  for (const TissueModel& model : some_tissues()) {
    const TissueCopy shadow = resting(model);
    TissueCopy felt = shadow;
    WorkTank tank;
    ModelFade fade;
    EXPECT_NEAR(fade.pass(felt, shadow, x, 0.08, tank, 1), 0, 1e-15);
    EXPECT_NEAR(felt.state.q[0], shadow.state.q[0], 1e-15);
    EXPECT_NEAR((felt.state.force - shadow.state.force).norm(), 0, 1e-12);
  }
}

TEST(ModelFade, MixesTheSurfaceStraight) {
  const TissueCopy a = resting(lump(0.1, 2, 200)), b = resting(lump(0.3, 1, 100), 1e-3);
  const Vec3 from = modal_surface(a.step.model(), a.state), to = modal_surface(b.step.model(), b.state);
  for (const double beta : {0.0, 0.25, 0.5, 1.0}) {
    const TissueCopy m = mixed(a, b, beta);
    EXPECT_NEAR((modal_surface(m.step.model(), m.state) - from - beta * (to - from)).norm(), 0, 1e-15);
  }
}

/// Energy that comes in is the tank's, tick by tick, and forces grow by no more than the step allowed.
TEST(ModelFade, IsPaidByTheTank) {
  TissueCopy felt = resting(lump(0.1, 2, 100));
  const TissueCopy shadow = resting(lump(0.1, 2, 1000));
  WorkTank tank;
  ModelFade fade;
  double before = felt.step.held(felt.state, x).energy, force = pressed(felt.state);
  ASSERT_LT(force, pressed(shadow.state));
  for (int n = 0; n < 3000; ++n) {
    const double level = tank.level();
    const double put_in = fade.pass(felt, shadow, x, 0.02, tank, 1);
    EXPECT_NEAR(felt.step.held(felt.state, x).energy - before, put_in, 1e-15);
    EXPECT_LE(put_in, level + 1e-18);
    EXPECT_LE(std::abs(pressed(felt.state) - force), 0.02 + 1e-12);
    tank.pass(h, true);
    before = felt.step.held(felt.state, x).energy;
    force = pressed(felt.state);
  }
  EXPECT_NEAR(pressed(felt.state), pressed(shadow.state), 1e-3);
}

/// A cut falls with 10 ms, to the end; what falls after a ripple does so with 50 ms.
TEST(ModelFade, FallsFastAfterAnEventOnly) {
  const TissueCopy whole = resting(lump(0.1, 2, 1000)), cut = resting(lump(0.1, 2, 200));
  const double below = pressed(whole.state) - pressed(cut.state);
  ASSERT_GT(below, 0.3);
  const double quick = ModelFade::quick * std::log(below / 0.05) / h;
  EXPECT_NEAR(ticks_to(whole, cut), quick, 0.4 * quick);
  EXPECT_GT(ticks_to(whole, cut, 1), 3 * quick);
}

/// A normal that turns takes the force with it, no faster than forces may change and paid like all else.
TEST(ModelFade, TurnsTheNormalPaid) {
  TissueCopy felt = resting(leaning(0)), shadow = felt;
  TissueModel turned = leaning(0);
  turned.normal = Vec3(-0.5, 0, 1).normalized();
  shadow.step = TissueStep(turned, {500, 1}, h);
  ModelFade fade;
  WorkTank tank;
  for (int n = 0; n < 2000; ++n) {
    const double before = felt.step.held(felt.state, x).energy;
    const Vec3 force = felt.state.force;
    const double put_in = fade.pass(felt, shadow, x, 0.05, tank, 1);
    EXPECT_NEAR(felt.step.held(felt.state, x).energy - before, put_in, 1e-12);
    EXPECT_LE((felt.state.force - force).norm(), 0.05 + 1e-12);
    EXPECT_NEAR(felt.step.model().normal.norm(), 1, 1e-12);
    tank.pass(h, true);
  }
  EXPECT_NEAR((felt.step.model().normal - turned.normal).norm(), 0, 1e-6);
}

/// A tip in the air is no way around the tank: what the hand would meet later is paid when it is put in. The rest costs nothing.
TEST(ModelFade, IsPaidInTheAirToo) {
  const Vec3 above = down(-5e-3);
  TissueCopy felt{TissueStep(lump(0.1, 2, 100), {500, 1}, h), {}}, shadow = felt;
  shadow.state.rest = down(1e-3);
  WorkTank empty;
  empty.book(WorkTank::capacity);
  ModelFade fade;
  EXPECT_EQ(fade.pass(felt, shadow, above, 0.08, empty, 1), 0);
  EXPECT_NEAR(felt.state.rest.z(), 1e-3 * std::expm1(-h / ModelFade::slow), 1e-12);
  shadow.state.w[0] = 1;  // half a joule
  TissueCopy held = felt;
  fade.pass(held, shadow, above, 0.08, empty, 1);
  EXPECT_EQ(tissue_energy(held.step.model(), held.state), 0);
  WorkTank full;
  const double put_in = fade.pass(felt, shadow, above, 0.08, full, 1);
  EXPECT_NEAR(tissue_energy(felt.step.model(), felt.state), put_in, 1e-15);
  EXPECT_GT(put_in, 0.9 * WorkTank::capacity);
  EXPECT_LE(put_in, WorkTank::capacity);
}

}  // namespace
}  // namespace palpate::haptic
