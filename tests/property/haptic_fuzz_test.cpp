// Whatever comes over the wire, the hand gets a finite, limited force, and patches that are wrong count for nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/scene/device_spec.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

class Rubbish {
 public:
  explicit Rubbish(std::uint64_t seed) : random_(seed) {}

  double number() {
    switch (pick(9)) {
      case 0:
        return std::numeric_limits<double>::quiet_NaN();
      case 1:
        return std::numeric_limits<double>::infinity();
      case 2:
        return -std::numeric_limits<double>::infinity();
      case 3:
        return 1e30;
      case 4:
        return -1e-300;
      case 5:
        return 0;
      default:
        return 0.1 * (static_cast<double>(pick(2001)) / 1000 - 1);
    }
  }

  /// A whole patch that is often nearly right.
  ContactPatch patch() {
    // A tick of nonsense that is accepted after a silence shuts the next ones out until the next silence.
    ContactPatch patch = flat_patch(pick(50) == 0 ? random_() : tick_ += 1 + pick(3));
    patch.contact_set = pick(3);
    patch.n_facets = pick(4) == 0 ? static_cast<std::uint32_t>(random_()) : pick(5);
    const std::uint32_t spoilt = pick(4);
    for (std::uint32_t i = 0; i < spoilt; ++i) spoil(patch.facets[pick(4)]);
    if (pick(20) == 0) patch.tool = pick(3);
    return patch;
  }

  /// Sound, but nonsense: planes anywhere, any stiffness, all the time.
  ContactPatch wild() {
    ContactPatch patch = flat_patch(++tick_);
    patch.contact_set = random_();
    patch.n_facets = pick(max_patch_facets + 1);
    for (PatchFacet& facet : patch.facets) {
      for (Array3& corner : facet.corners) corner = point();
      facet.point = point();
      Array3 n = point();
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) + 1e-12;
      for (double& c : n) c /= length;
      facet.normal = n;
      facet.stiffness = std::pow(10.0, static_cast<double>(pick(12)) - 3);
      facet.damping = 1;
    }
    return patch;
  }

 private:
  std::uint32_t pick(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  Array3 point() {
    Array3 p;
    for (double& c : p) c = 0.02 * (static_cast<double>(pick(2001)) / 1000 - 1);
    return p;
  }
  void spoil(PatchFacet& facet) {
    double* const fields[] = {&facet.corners[1][2], &facet.point[0],  &facet.normal[1],
                              &facet.velocity[2],   &facet.stiffness, &facet.damping};
    *fields[pick(6)] = number();
  }

  std::mt19937_64 random_;
  std::uint64_t tick_ = 0;
};

TEST(AnyPatch, LeavesTheForceFiniteAndLimitedInEveryTick) {
  VirtualWorld world(
      scene_with(HandModel::arm, {{0, {0, 0, 0.02}}, {1, {0, 0, -0.01}}, {100, {0.01, 0, -0.01}}}));
  world.run(0.2, 1000);
  ASSERT_EQ(world.session.state(), HapticState::run);
  Rubbish rubbish(1);
  world.has_patch = true;
  for (int i = 0; i < 100'000; ++i) {
    world.patch = rubbish.patch();
    world.run(0.001, 0);
    ASSERT_TRUE(std::isfinite(world.force()));
    ASSERT_LE(world.force(), 3.0 * (1 + 1e-12));
    ASSERT_TRUE(std::isfinite(world.session.trace().energy));
    for (const double c : world.session.tool_state().proxy) ASSERT_TRUE(std::isfinite(c));
  }
  EXPECT_GT(world.session.counts().patches_rejected, 10'000u);
  EXPECT_GT(world.session.counts().patches_taken, 1'000u);
  EXPECT_NE(world.session.state(), HapticState::fault);
}

TEST(AnyPatch, ThatIsSoundButWildMovesTheForceInLimitedStepsAndPaysForItsWork) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    VirtualWorld world(scene_with(HandModel::rigid, {{0, {0, 0, 0.01}}, {10, {0.001, 0, -0.005}}}));
    world.run(0.2, 1000);
    Rubbish rubbish(seed);
    Array3 last{};
    double work = world.session.controller().plane_work();
    world.has_patch = true;
    for (int i = 0; i < 20'000; ++i) {
      world.patch = rubbish.wild();
      world.run(0.001, 0);
      const Array3& f = world.session.trace().force;
      ASSERT_TRUE(std::isfinite(world.force()));
      ASSERT_LE(world.force(), 3.0 * (1 + 1e-12));
      const double rise = world.force() - std::hypot(last[0], last[1], last[2]);  // it may fall at once
      ASSERT_LE(rise, 0.4 * (1 + 1e-9));
      const double now = world.session.controller().plane_work();
      ASSERT_LE(now - work, WorkTank::capacity * (1 + 1e-9));
      work = now;
      last = f;
    }
  }
}

TEST(OnlyBadPatches, AreAsGoodAsSilence) {
  VirtualWorld world(scene_with(HandModel::rigid, press(0.004)));
  world.run(1, 150);
  ASSERT_GT(world.fz(), 1.0);
  for (int i = 0; i < 400; ++i) {
    world.patch.tick += 1;
    world.patch.facets[1].stiffness = -1;
    world.run(0.001, 0);
  }
  EXPECT_EQ(world.force(), 0.0);
  EXPECT_EQ(world.session.state(), HapticState::stale);
  EXPECT_EQ(world.session.counts().patches_rejected, 400u);
}

TEST(Planes, ThatJumpIntoTheHandPushGently) {
  for (const double jump : {0.002, 0.010, 0.020}) {
    VirtualWorld world(scene_with(HandModel::rigid, {{0, {0, 0, 0.001}}, {1, {0, 0, 0.001}}}));
    world.run(0.5, 1000);
    world.patch.facets[0].point[2] = world.patch.facets[1].point[2] = jump;
    double last = 0;
    world.run(0.02, 1000, [&] {
      ASSERT_LE(std::abs(world.fz() - last), 0.1 + 1e-9);
      last = world.fz();
    });
    EXPECT_LE(world.session.controller().plane_work(), WorkTank::capacity + WorkTank::trickle * 0.02 + 1e-9);
  }
}

}  // namespace
}  // namespace palpate::haptic::test
