// Forceps: what the hand pulls with is what tissue gets, never more than the grip, on springs and finite elements.

#include "physics_node/contact/grip_tool.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/recorded_hand.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double top = 0.010;  // of the block [m]

Recipe block(const std::string& model, const std::string& keys = "grip_N = 50", int viscosity = 20) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(20, 20, 1e3 * top);
  recipe.spacing_mm = 2;
  recipe.material =
      fmt::format("density_kg_per_m3 = 1000\nmodulus_kPa = 20\nviscosity_Pa_s = {}\n", viscosity) +
      std::string(model == "fem" ? "poisson_ratio = 0.45\n" : "");
  recipe.body = fmt::format("model = \"{}\"\nfixed = [\"-z\"]", model);
  recipe.physics = "frame_Hz = 1000";
  recipe.world = fmt::format(
      "[[tool]]\nname = \"jaws\"\nshape = \"forceps\"\nradius_mm = 4\ndevice = \"hand\"\n"
      "stiffness_N_per_m = 500\n{}\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 10], [1, 0, 0, 10]]\n",
      keys);
  return recipe;
}

struct Held {
  explicit Held(const Recipe& recipe) : world(scene_of(recipe)) {
    Eigen::AlignedBox3d box;
    for (const Index node : world.body(0).body().nodes())
      box.extend(world.body(0).body().rest_position(node));
    start = Vec3(box.center().x(), box.center().y(), box.max().z());
    path = {start, start};
  }
  /// A frame after which the hand is there. @return force on tissue
  Vec3 to(const Vec3& tip, bool pressed = true) {
    path.push_back(tip);
    std::optional<ToolState> hand = recorded_hand(
        [this](double t) { return path[static_cast<std::size_t>(std::llround(1e3 * t))]; }, path.size() - 1);
    hand->stiffness = 500;
    hand->buttons = pressed ? 1 : 0;
    world.frame(std::span(&hand, 1));
    return -world.tool(0).borne();
  }
  /// Straight there, then waits.
  Vec3 pull(const Vec3& way, double seconds, double wait = 0) {
    const Vec3 begin = path.back();
    const int n = static_cast<int>(1e3 * seconds);
    Vec3 force = Vec3::Zero();
    for (int i = 1; i <= n; ++i) most = std::max(most, (force = to(begin + way * i / n)).norm());
    for (int i = 0; i < static_cast<int>(1e3 * wait); ++i) force = to(begin + way);
    return force;
  }
  Vec3 momentum() const {
    Vec3 p = Vec3::Zero();
    const BodyModel& body = world.body(0);
    for (const Index node : body.body().nodes())
      if (const double inverse = body.body().inverse_mass[static_cast<std::size_t>(node)]; inverse > 0)
        p += body.velocity(node) / inverse;
    return p;
  }

  World world;
  Vec3 start;
  std::vector<Vec3> path;
  double most = 0;
};

class Forceps : public testing::TestWithParam<const char*> {};

TEST_P(Forceps, PullsAsTheHandsSpringSaysAndTissueBearsIt) {
  Held held(block(GetParam()));
  const Vec3 force = held.pull(Vec3(0, 0, 0.003), 0.2, 1.0);
  EXPECT_GT(force.z(), 0.05);
  EXPECT_LT(force.head<2>().norm(), 1e-3 * force.z());
  // At rest: the spring is as long as the force says, and the elastic energy is half of what a linear pull would have done, or about.
  const EnergyLedger ledger = held.world.ledger();
  const double stretch = force.z() / 500, tissue = 0.003 - stretch;
  EXPECT_GT(tissue, 0);
  EXPECT_NEAR(ledger.elastic, 0.5 * force.z() * tissue, 0.15 * ledger.elastic);
  EXPECT_LT(ledger.balance_error(), 1e-3);
  EXPECT_LT(ledger.kinetic, 1e-4 * ledger.elastic);
  // The hand's own books agree with tissue's but for what its spring holds.
  EXPECT_NEAR(held.world.tool(0).book().tissue_work(), ledger.tool_work, 1e-12);
  // And when it opens there is no force, and tissue goes back.
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(held.to(held.path.back(), false).isZero(0));
  EXPECT_LT(held.world.ledger().elastic, 1e-3 * ledger.elastic);
}

TEST_P(Forceps, GivesAFreeBodyTheMomentumOfItsForce) {
  Recipe recipe = block(GetParam(), "", 1);
  recipe.body = fmt::format("model = \"{}\"", GetParam());
  recipe.physics = "frame_Hz = 20000";  // of one step each
  Held held(recipe);
  Vec3 impulse = Vec3::Zero();
  for (int i = 1; i <= 200; ++i) impulse += 5e-5 * held.to(held.start + Vec3(1e-6 * i, 2e-6 * i, 4e-6 * i));
  for (int i = 0; i < 3; ++i) held.to(held.path.back(), false);
  EXPECT_EQ(held.world.report().steps, 203);
  EXPECT_GT(impulse.norm(), 1e-6);
  EXPECT_LT((held.momentum() - impulse).norm(), 1e-6 * impulse.norm());
}

TEST_P(Forceps, SlipAtTheGripAndLetGoOfWhatHasSlippedOut) {
  Held held(block(GetParam(), "grip_N = 0.1"));
  held.pull(Vec3(0, 0, 0.002), 0.1);
  EXPECT_GT(held.world.tool(0).contacts(), 0U);
  EXPECT_NEAR(held.most, 0.1, 1e-9);
  ToolWrench told;
  held.world.tool(0).write_wrench(told, 1, 0, 0);
  EXPECT_NEAR(told.force[2], -0.1, 1e-6);
  EXPECT_EQ(told.stiffness[14], 500) << "else the hand would not feel it";
  held.pull(Vec3(0, 0, 0.02), 0.5);
  EXPECT_LE(held.most, 0.1 + 1e-9);
  EXPECT_EQ(held.world.tool(0).contacts(), 0U);
  // Pressed all the time it takes no new hold, though it comes back; pressed again it does.
  held.pull(Vec3(0, 0, -0.022), 0.3);
  EXPECT_EQ(held.world.tool(0).contacts(), 0U);
  held.to(held.start, false);
  held.to(held.start, true);
  EXPECT_GT(held.world.tool(0).contacts(), 0U);
}

TEST_P(Forceps, PullTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    Recipe recipe = block(GetParam());
    recipe.physics += fmt::format("\nthreads = {}", threads);
    Held held(recipe);
    held.pull(Vec3(0.001, 0, 0.002), 0.05);
    hashes.push_back(held.world.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

INSTANTIATE_TEST_SUITE_P(Models, Forceps, testing::Values("springs", "fem"),
                         [](const testing::TestParamInfo<const char*>& one) {
                           return std::string(one.param);
                         });

TEST(GripTool, HoldsNothingWhereNothingIs) {
  Held held(block("springs"));
  held.path = {held.start + Vec3(0, 0, 0.02), held.start + Vec3(0, 0, 0.02)};
  EXPECT_TRUE(held.pull(Vec3(0, 0, -0.02), 0.2).isZero(0)) << "closed in the air, it has not opened since";
  EXPECT_EQ(held.world.tool(0).contacts(), 0U);
}

/// Cut through between the jaws, tissue stays in them on both sides, and whoever closes them on a cut holds both of its lips.
TEST(GripTool, HoldsBothSidesOfACut) {
  Recipe recipe = block("fem");
  recipe.material += "cut_toughness_J_per_m2 = 100\n";
  recipe.world +=
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 10\ndevice = \"other\"\n"
      "[device.other]\ndriver = \"simulated\"\nwaypoints = [[0, 90, 0, 0], [1, 90, 0, 0]]\n";
  Held held(recipe);
  BodyModel& moving = held.world.body(0);
  const Body& body = moving.body();
  const CellNet& net = *body.cell_net();
  const Vec3 before = held.pull(Vec3(0, 0, 0.001), 0.05);
  const std::uint32_t n_held = held.world.tool(0).contacts();
  std::vector<EdgeGone> faces;
  for (const Index cell : net.cells())
    if (const Index other = net.beyond(cell, 3);
        other != CellNet::none && std::abs(body.rest_position(other).y() - held.start.y()) < 1e-4)
      faces.push_back({cell, other, {}});
  ASSERT_EQ(moving.cut(faces), 50);
  const Vec3 after = held.to(held.path.back());
  EXPECT_LT((after - before).norm(), 0.3 * before.norm()) << "but for what held across the cut";
  const std::uint32_t on_the_cut = held.world.tool(0).contacts() - n_held;
  EXPECT_GT(on_the_cut, 5U);
  held.pull(Vec3(0, 0, 0.002), 0.1, 0.3);
  const auto top_of_cut = [&](Index node) {
    return body.rest_position(node).z() > held.start.z() - 1e-4 &&
           (body.rest_position(node) - held.start).norm() < 1e-4;
  };
  int seen = 0;
  body.each_copy([&](Index copy) {
    if (!top_of_cut(copy)) return;
    ++seen;
    const double lip = moving.displacement(copy).z(), other = moving.displacement(net.origin(copy)).z();
    EXPECT_GT(lip, 5e-4);
    EXPECT_NEAR(lip, other, 0.1 * lip);
  });
  EXPECT_EQ(seen, 1);
  for (int i = 0; i < 300; ++i) held.to(held.start, false);
  held.to(held.start, true);
  EXPECT_GT(held.world.tool(0).contacts(), n_held + on_the_cut / 2);
}

TEST(GripTool, RefusesImplicitSteps) {
  Recipe recipe = block("springs");
  recipe.physics += "\nintegrator = \"backward_euler\"";
  try {
    World world(scene_of(recipe));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("forceps hold step by step"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace palpate::physics::test
