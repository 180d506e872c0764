#include "physics_node/contact/stick_tool.h"

#include <gtest/gtest.h>

#include "common/message/vec3.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/world.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

using namespace test;

constexpr double r = 0.003, L = 0.08;

/// A stick that lies along x over the slab; its tip begins at x = -40 mm.
Scene stick_on_slab(const std::string& physics = "", const std::string& body = "fixed = [\"-z\"]") {
  Recipe recipe = pressed_slab_recipe();
  recipe.physics = physics;
  recipe.body = body;
  recipe.world =
      "[[tool]]\nname = \"stick\"\nshape = \"stick\"\nlength_mm = 80\nradius_mm = 3\ntheta_deg = [0, -90, "
      "0]\n"
      "device = \"hand\"\nlow_pass_Hz = 40\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, -40, 0, 50], [1, -40, 0, 40]]\n";
  return scene_of(recipe);
}

std::optional<ToolState> hand_at(const Vec3& p, std::uint64_t tick) {
  ToolState state;
  state.tick = tick;
  state.p_WT = state.proxy = array(p);
  state.engaged = 1;
  return state;
}

/// Moves the tip straight; @return frames so far
std::uint64_t lead(World& world, const Vec3& from, const Vec3& to, int frames, std::uint64_t tick) {
  for (int n = 1; n <= frames; ++n) {
    const auto hand = hand_at(from + (to - from) * (static_cast<double>(n) / frames), ++tick);
    world.frame(std::span(&hand, 1));
  }
  return tick;
}

/// The deepest mass inside the stick [m].
double deepest(const World& world) {
  const auto& tool = dynamic_cast<const StickTool&>(world.tool(0));
  const Stick stick = tool.stick_at({tool.tip(), Eigen::Quaterniond::Identity()});
  double depth = 0;
  const Lattice& lattice = world.body(0).body().lattice;
  for (const RowSegment& row : lattice.rows)
    for (Index c = row.first; c < row.first + row.count; ++c) {
      const Vec3 x = world.body(0).position(c);
      depth = std::max(depth, r - (x - stick.axis_point(stick.nearest(x))).norm());
    }
  return depth;
}

TEST(StickTool, LiesWhereItsAnglesPutIt) {
  World world(stick_on_slab());
  lead(world, {-0.04, 0, 0.05}, {-0.04, 0, 0.05}, 2, 0);
  const Stick stick = dynamic_cast<const StickTool&>(world.tool(0))
                          .stick_at({world.tool(0).tip(), Eigen::Quaterniond::Identity()});
  EXPECT_LT((stick.A - Vec3(-0.04, 0, 0.05)).norm(), 1e-12);
  EXPECT_LT((stick.D - Vec3(L, 0, 0)).norm(), 1e-12);
}

TEST(StickTool, FeelsNothingInTheAir) {
  World world(stick_on_slab());
  lead(world, {-0.04, 0, slab_top + 0.02}, {-0.04, 0, slab_top + 0.0031}, 100, 0);
  EXPECT_EQ(world.tool(0).raw_wrench().force, Vec3(Vec3::Zero()));
  EXPECT_EQ(world.tool(0).contacts(), 0u);
}

/// F = dE/dz: what the hand feels at rest is what the tissue's elastic energy grows by. (EQUATIONS C-35)
TEST(StickTool, FeelsTheGradientOfTheElasticEnergy) {
  World world(stick_on_slab());
  const auto settle = [&](const Vec3& from, const Vec3& to, std::uint64_t tick) {
    tick = lead(world, from, to, 200, tick);
    return lead(world, to, to, 1500, tick);
  };
  const double z = slab_top + r;
  const Vec3 deep(-0.04, 0, z - 0.002), deeper(-0.04, 0, z - 0.0022);
  std::uint64_t tick = lead(world, {-0.04, 0, z + 0.002}, {-0.04, 0, z + 0.001}, 50, 0);
  tick = settle({-0.04, 0, z + 0.001}, deep, tick);
  const double E_0 = world.body(0).energies(Vec3::Zero()).elastic;
  const Vec3 F_0 = world.tool(0).force();
  tick = settle(deep, deeper, tick);
  const double E_1 = world.body(0).energies(Vec3::Zero()).elastic;
  const Vec3 F_1 = world.tool(0).force();
  EXPECT_GT(F_0.z(), 0.2) << "the press must be felt, or this shows nothing";
  EXPECT_NEAR((E_1 - E_0) / 0.0002, 0.5 * (F_0.z() + F_1.z()), 0.02 * F_1.z());
  EXPECT_LT(F_1.head<2>().norm(), 0.02 * F_1.z());
  EXPECT_LT(deepest(world), 1e-6);
  EXPECT_LT(std::abs(world.ledger().balance_error()), 0.01);
  // The stick lies over the whole slab, whose middle is the set point.
  EXPECT_LT(std::abs(world.tool(0).wrench().moment.y()), 0.02 * F_1.z() * L);
}

TEST(StickTool, LetsNothingThrough) {
  for (const double speed : {0.2, 1.0, 2.0}) {
    World world(stick_on_slab());
    const double way = 0.012, z = slab_top + r + 0.001;
    const int frames = std::max(2, static_cast<int>(way / speed / world.frame_seconds()));
    std::uint64_t tick = lead(world, {-0.04, 0, z}, {-0.04, 0, z}, 2, 0);
    tick = lead(world, {-0.04, 0, z}, {-0.04, 0, z - way}, frames, tick);
    lead(world, {-0.04, 0, z - way}, {-0.04, 0, z - way}, 30, tick);
    EXPECT_LT(deepest(world), 1e-6) << speed << " m/s";
    EXPECT_EQ(world.report().nonfinite, 0) << speed << " m/s";
    // The row that it came down on is under it still; its neighbours, 4 mm aside, close above it.
    const Lattice& lattice = world.body(0).body().lattice;
    for (const RowSegment& row : lattice.rows)
      for (Index c = row.first; c < row.first + row.count; ++c) {
        if (std::abs(lattice.rest_position(c).y()) > 1e-9) continue;
        EXPECT_LT(world.body(0).position(c).z(), world.tool(0).tip().z()) << speed << " m/s";
      }
  }
}

TEST(StickTool, TellsATangentThatPredictsTheForce) {
  World world(stick_on_slab());
  const double z = slab_top + r;
  std::uint64_t tick = lead(world, {-0.04, 0, z + 0.001}, {-0.04, 0, z - 0.0015}, 250, 0);
  // Slow strokes, from which the stiffness is learnt.
  for (int n = 0; n < 6; ++n) {
    tick = lead(world, {-0.04, 0, z - 0.0015}, {-0.04, 0, z - 0.0025}, 200, tick);
    tick = lead(world, {-0.04, 0, z - 0.0025}, {-0.04, 0, z - 0.0015}, 200, tick);
  }
  tick = lead(world, {-0.04, 0, z - 0.0015}, {-0.04, 0, z - 0.0015}, 500, tick);
  ToolWrench wrench;
  world.tool(0).write_wrench(wrench, 1, 1, world.t());
  const double K_t = dynamic_cast<const StickTool&>(world.tool(0)).tangent().stiffness()(2, 2);
  const double predicted = wrench.force[2] + K_t * 0.001;
  tick = lead(world, {-0.04, 0, z - 0.0015}, {-0.04, 0, z - 0.0025}, 400, tick);
  lead(world, {-0.04, 0, z - 0.0025}, {-0.04, 0, z - 0.0025}, 500, tick);
  EXPECT_NEAR(world.tool(0).force().z(), predicted, 0.15 * predicted);
  // The hand is told what it feels through its spring, and where it is then.
  const double K = world.scene().tools[0].stiffness;
  EXPECT_NEAR(wrench.p_WT[2], wrench.tip[2] - wrench.force[2] / K, 1e-12);
  EXPECT_NEAR(wrench.stiffness[14], K * K_t / (K + K_t), 0.01 * K_t);
}

double gap_of(World& world, ContactPatch& patch) {
  world.tool(0).write_patch(patch, 1, 1);
  if (patch.n_facets == 0) return 1;
  const PatchFacet& facet = patch.facets[0];
  return vec(facet.normal).dot(world.tool(0).tip() - vec(facet.point));
}

TEST(StickTool, OffersThePlaneUnderItBeforeItTouches) {
  World world(stick_on_slab());
  ContactPatch patch;
  const double z = slab_top + r;
  std::uint64_t tick = lead(world, {-0.04, 0, z + 0.05}, {-0.04, 0, z + 0.05}, 2, 0);
  EXPECT_EQ(gap_of(world, patch), 1) << "nothing is near";
  // The same height above rows of masses and between them.
  for (const double y : {0.0, 0.001, 0.002, 0.003}) {
    tick = lead(world, {-0.04, y, z + 0.002}, {-0.04, y, z + 0.001}, 30, tick);
    EXPECT_NEAR(gap_of(world, patch), 0.001, 1e-9) << y;
    ASSERT_EQ(patch.n_facets, 2u);
    EXPECT_LT((vec(patch.facets[1].normal) - Vec3::UnitZ()).norm(), 1e-9) << y;
  }
}

TEST(StickTool, OffersThePlaneWhereItWouldBeWithoutTheForce) {
  World world(stick_on_slab());
  ContactPatch patch;
  const double z = slab_top + r, d = 0.002;
  std::uint64_t tick = lead(world, {-0.04, 0, z + 0.002}, {-0.04, 0, z - d}, 300, 0);
  lead(world, {-0.04, 0, z - d}, {-0.04, 0, z - d}, 2000, tick);
  EXPECT_NEAR(gap_of(world, patch), -d, 1e-9) << "at rest the surface is where it was";
  const double F = world.tool(0).force().z();
  ASSERT_GT(F, 0.2);
  EXPECT_NEAR(patch.facets[0].stiffness, F / d, 0.01 * F / d);
}

ToolWrench wrench_of(const World& world) {
  ToolWrench wrench;
  world.tool(0).write_wrench(wrench, 1, 1, world.t());
  return wrench;
}

double at(const ToolWrench& wrench, std::size_t row, std::size_t column) {
  return wrench.stiffness[6 * row + column];
}

TEST(StickTool, OffersASpringBeforeItTouches) {
  World world(stick_on_slab());
  const double z = slab_top + r;
  std::uint64_t tick = lead(world, {-0.04, 0, z + 0.05}, {-0.04, 0, z + 0.05}, 2, 0);
  EXPECT_EQ(wrench_of(world).normal, Array3{}) << "nothing is near";
  lead(world, {-0.04, 0, z + 0.002}, {-0.04, 0, z + 0.001}, 30, tick);
  const ToolWrench wrench = wrench_of(world);
  EXPECT_EQ(wrench.force, Array3{});
  EXPECT_LT((vec(wrench.normal) - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(wrench.stretch, -0.001, 1e-9);
  const double k = at(wrench, 2, 2);
  EXPECT_GT(k, 10);
  // The slab's middle is 40 mm from the tip; it reaches 24 mm to either side and the weights some millimetres more.
  EXPECT_NEAR(at(wrench, 2, 4), -0.040 * k, 0.01 * 0.040 * k);
  const double K = world.scene().tools[0].stiffness, k_tissue = K * k / (K - k);
  const double turning = at(wrench, 4, 4) - 0.040 * 0.040 * k;  // about the middle
  EXPECT_NEAR(turning, k_tissue * 0.048 * 0.048 / 12, 0.1 * turning);
  for (const std::size_t free : {0U, 1U, 3U, 5U})
    for (std::size_t n = 0; n < 6; ++n) EXPECT_NEAR(at(wrench, free, n), 0, 1e-9 * k) << free << ", " << n;
}

/// The tissue ends 34 mm from the tip and begins at it: it presses harder where it is open on one side only, and the force
/// lies elsewhere than in the middle.
TEST(StickTool, OffersASpringThatPressesAsTheTissueDoes) {
  World world(stick_on_slab());
  const double z = slab_top + r, d = 0.002, x = -0.01;
  std::uint64_t tick = lead(world, {x, 0, z + 0.002}, {x, 0, z - d}, 300, 0);
  lead(world, {x, 0, z - d}, {x, 0, z - d}, 2000, tick);
  const ToolWrench wrench = wrench_of(world);
  const Vec3 force = vec(wrench.force);
  const Vec3 moment = vec(wrench.moment) + (vec(wrench.set_point) - vec(wrench.tip)).cross(force);
  ASSERT_GT(force.z(), 0.1);
  Vec6 stretch;
  stretch << wrench.stretch * vec(wrench.normal), Vec3::Zero();
  const Vec6 told =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(wrench.stiffness.data()) * stretch;
  EXPECT_NEAR(told[2], force.z(), 0.01 * force.z());
  EXPECT_NEAR(told[4], moment.y(), 0.01 * std::abs(moment.y()));
  EXPECT_GT(std::abs(moment.y() / force.z() + 0.017), 2e-4) << "in the middle this would show nothing";
}

TEST(StickTool, KnowsThePlaneHoweverDeepItIs) {
  World world(stick_on_slab());
  ContactPatch patch;
  const double z = slab_top + r;
  std::uint64_t tick = lead(world, {-0.04, 0, z + 0.001}, {-0.04, 0, z}, 20, 0);
  for (double d = 0; d < 0.0085; d += 0.001) {
    tick = lead(world, {-0.04, 0, z - d}, {-0.04, 0, z - d - 0.001}, 60, tick);
    EXPECT_NEAR(gap_of(world, patch), -d - 0.001, 1e-9);
  }
}

TEST(StickTool, FeelsHeldMassesAsHard) {
  World soft(stick_on_slab()), hard(stick_on_slab("", "fixed = [\"+z\"]"));
  ContactPatch patch;
  for (World* world : {&soft, &hard}) {
    lead(*world, {-0.04, 0, slab_top + r + 0.002}, {-0.04, 0, slab_top + r + 0.001}, 30, 0);
    EXPECT_NEAR(gap_of(*world, patch), 0.001, 1e-9);
    if (world == &soft)
      EXPECT_LT(patch.facets[0].stiffness, 1e5);
    else
      EXPECT_EQ(patch.facets[0].stiffness, rigid_stiffness);
  }
}

TEST(StickTool, IsRefusedWhereItCouldNotWork) {
  EXPECT_THROW(World(stick_on_slab("integrator = \"backward_euler\"")), std::exception);
}

}  // namespace
}  // namespace palpate::physics
