// An image of which only a part is stepped, near to where it is pressed: it answers as if all of it were.
#include <gtest/gtest.h>

#include <cmath>

#include "common/error/error.h"
#include "physics_node/contact/point_tool.h"
#include "physics_node/world.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double top = 0.036;  // [m]

class AwakeParts : public testing::Test {
 protected:
  /// A block of 100 x 100 x 72 mm in an image, in cells of 2 mm, held below.
  void SetUp() override { write_volume(block_volume({54, 54, 38}), folder_ / "block.h5"); }

  Recipe block(const std::string& deformable, const std::string& precision = "single") const {
    Recipe recipe;
    recipe.lattice = "";
    recipe.shape = "shape = \"volume\"\nmodel = \"fem\"\nkeep = [0, 1000]\nfile = \"" +
                   (folder_ / "block.h5") + "\"\ndeformable = " + deformable;
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45\nviscosity_Pa_s = 2";
    recipe.body = "fixed = [\"-z\"]";
    recipe.precision = precision;
    recipe.world = point_tool(5);
    return recipe;
  }
  Recipe awake(double mm) const { return block("{ awake_mm = " + std::to_string(mm) + " }"); }

  palpate::test::ScratchFolder folder_;
};

/// A hand that feels a force on the upper face.
class Hand {
 public:
  void frame(World& world, double force, const Vec3& beside = Vec3::Zero()) {
    frame(world, Vec3(0, 0, force), beside);
  }
  void frame(World& world, const Vec3& force, const Vec3& beside) {
    ToolState state;
    state.tick = ++tick_;
    const Vec3 at = Vec3(0.0004, 0.0007, top) + beside;
    state.p_WT = state.proxy = {at.x(), at.y(), at.z()};
    state.force_on_hand = state.force_now = {force.x(), force.y(), force.z()};
    state.engaged = 1;
    const std::optional<ToolState> hand = state;
    world.frame(std::span(&hand, 1));
  }
  void frames(World& world, int n, double force, const Vec3& beside = Vec3::Zero()) {
    for (int f = 0; f < n; ++f) frame(world, force, beside);
  }

 private:
  std::uint64_t tick_ = 0;
};

double depth_of(const World& world) { return dynamic_cast<const PointTool&>(world.tool(0)).depth(); }
double sleeping(const World& world) { return world.body(0).sleeping_fraction(); }

TEST_F(AwakeParts, AnswerAsTheWholeBodyDoes) {
  const auto depth = [](const Recipe& recipe) {
    World world(scene_of(recipe));
    Hand hand;
    hand.frames(world, 400, 0.1);
    EXPECT_EQ(world.report().restored, 0);
    return depth_of(world);
  };
  const double all = depth(block("\"all\""));
  EXPECT_GT(all, 0.001);
  EXPECT_NEAR(depth(awake(12)), all, 0.03 * all);
  EXPECT_NEAR(depth(awake(20)), all, 0.03 * all);
}

/// What stands out of a body bends at its foot, which lies further out than the radius asked for.
TEST_F(AwakeParts, AnswerAsTheWholeBodyDoesWhereTheyStandOut) {
  // A wall of 8 mm along x, 20 mm high: its side is pressed near its upper end.
  write_volume(made_volume({34, 34, 28},
                           [](int i, int j, int k) {
                             const bool base = i >= 2 && i < 32 && j >= 2 && j < 32 && k >= 1 && k < 17;
                             const bool wall = i >= 9 && i < 25 && j >= 15 && j < 19 && k >= 17 && k < 27;
                             return base || wall ? 100.0F : -100.0F;
                           }),
               folder_ / "block.h5");
  const auto moved = [](Recipe recipe) {
    // It would swing on.
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45\nviscosity_Pa_s = 30";
    World world(scene_of(recipe));
    Hand hand;
    for (int n = 0; n < 250; ++n) hand.frame(world, Vec3(0, -0.02, 0), Vec3(0, -0.004, -0.014));
    EXPECT_EQ(world.report().restored, 0);
    return depth_of(world);
  };
  const double all = moved(block("\"all\""));
  EXPECT_GT(all, 0.001);
  EXPECT_NEAR(moved(awake(20)), all, 0.03 * all);
}

TEST_F(AwakeParts, StandUnderTheirOwnWeightAndDoNothing) {
  Recipe recipe = awake(12);
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  const auto hash = world.state_hash();
  for (int n = 0; n < 50; ++n) world.frame({});
  EXPECT_EQ(world.state_hash(), hash);
  EXPECT_EQ(sleeping(world), 1);
  EXPECT_EQ(world.ledger().balance_error(), 0);
}

TEST_F(AwakeParts, AreAwakeNearThePressAndSleepAgain) {
  World world(scene_of(awake(12)));
  const auto hash = world.state_hash();
  Hand hand;
  hand.frames(world, 200, 0.05);
  EXPECT_LT(sleeping(world), 0.98);
  EXPECT_GT(sleeping(world), 0.7);
  const Body& body = world.body(0).body();
  for (const Index node : body.nodes())
    if ((body.rest_position(node) - Vec3(0, 0, top)).tail<2>().norm() > 0.022) {
      ASSERT_EQ(world.body(0).displacement(node), Vec3(0, 0, 0)) << body.rest_position(node).transpose();
    }
  hand.frames(world, 1100, 0, Vec3(0, 0, 0.02));
  EXPECT_EQ(sleeping(world), 1);
  EXPECT_EQ(world.state_hash(), hash);
}

TEST_F(AwakeParts, FollowAFingerThatSlides) {
  World world(scene_of(awake(12))), all(scene_of(block("\"all\"")));
  Hand hand, hand_of_all;
  double worst_step = 0, before = 0, worst_book = 0;
  for (int n = 0; n < 700; ++n) {
    const Vec3 beside(-0.02 + 4e-5 * std::clamp(n - 200, 0, 1000), 0, 0);
    hand.frame(world, 0.1, beside);
    hand_of_all.frame(all, 0.1, beside);
    if (n >= 200) {
      EXPECT_NEAR(depth_of(world), depth_of(all), 0.05 * depth_of(all)) << n;
      worst_step = std::max(worst_step, std::abs(depth_of(world) - before));
    }
    before = depth_of(world);
    if (n % 50 == 49)
      worst_book = std::max(worst_book, world.ledger().balance_error() - all.ledger().balance_error());
  }
  EXPECT_LT(worst_step, 0.01 * depth_of(world));
  EXPECT_LT(worst_book, 0.005);
  // What wakes and sleeps on the way is little of what there is.
  EXPECT_LT(std::abs(world.ledger().numerical), 0.05 * world.ledger().exchanged);
  // Behind the finger it sleeps again.
  const Body& body = world.body(0).body();
  for (const Index node : body.nodes())
    if ((body.rest_position(node) - Vec3(0, 0, top)).z() < -0.03) {
      ASSERT_EQ(world.body(0).displacement(node), Vec3(0, 0, 0));
    }
}

/// Rows that sleep and wake again do not count what they lost before once more.
TEST_F(AwakeParts, KeepTheirBooksToAndFro) {
  World world(scene_of(awake(12))), all(scene_of(block("\"all\"")));
  for (int turn = 0; turn < 2; ++turn) {
    Hand hand, hand_of_all;
    for (int n = 0; n < 450; ++n) {
      const Vec3 beside(0.02 * std::sin(2 * M_PI * n / 300), 0, 0);
      hand.frame(world, 0.1, beside);
      if (turn == 0) hand_of_all.frame(all, 0.1, beside);
    }
    EXPECT_NEAR(world.ledger().balance_error(), all.ledger().balance_error(), 0.003) << turn;
    EXPECT_NEAR(world.ledger().dissipated, all.ledger().dissipated, 0.05 * all.ledger().dissipated) << turn;
    world.reset();
  }
}

TEST_F(AwakeParts, KeepTheirBooksThroughATap) {
  for (const char* precision : {"single", "double"}) {
    World world(scene_of(block("{ awake_mm = 12 }", precision)));
    Hand hand;
    for (int n = 0; n < 400; ++n) {
      const double force = n < 100 ? 0.2 * std::pow(std::sin(M_PI * n / 100), 2) : 0;
      hand.frame(world, force);
      if (n % 20 == 19) {
        EXPECT_LT(world.ledger().balance_error(), 0.005) << precision << ' ' << n;
      }
    }
    EXPECT_EQ(world.report().restored, 0);
  }
}

TEST_F(AwakeParts, AreTheSameBitsOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3}) {
    Recipe recipe = awake(12);
    recipe.physics = "threads = " + std::to_string(threads);
    World world(scene_of(recipe));
    Hand hand;
    for (int n = 0; n < 150; ++n) hand.frame(world, 0.1, Vec3(6e-5 * n, 2e-5 * n, 0));
    if (threads == 1) first = world.state_hash();
    EXPECT_EQ(world.state_hash(), first) << threads << " threads";
  }
}

/// A stick moves masses by impulses, not by forces.
TEST_F(AwakeParts, AreWokenByAStick) {
  Recipe recipe = awake(15);
  recipe.world =
      "[[tool]]\nname = \"rod\"\nshape = \"stick\"\nradius_mm = 6\nlength_mm = 30\ndevice = \"hand\"\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n";
  World world(scene_of(recipe));
  for (int n = 0; n < 100; ++n) {
    ToolState state;
    state.tick = static_cast<std::uint64_t>(n) + 1;
    state.p_WT = state.proxy = {-0.015, 0.0003, top + 0.007 - 2e-5 * n};
    state.q_WT = {std::sqrt(0.5), 0, std::sqrt(0.5), 0};  // it lies along x
    state.engaged = 1;
    const std::optional<ToolState> hand = state;
    world.frame(std::span(&hand, 1));
  }
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_LT(sleeping(world), 0.98);
  EXPECT_GT(sleeping(world), 0.5);
  EXPECT_LT(world.ledger().balance_error(), 0.05);
  EXPECT_GT(world.ledger().elastic, 0.2 * world.ledger().exchanged);
}

TEST_F(AwakeParts, AreRefusedWhereTooLittleIsLeftToHoldThem) {
  Recipe recipe = awake(20);
  recipe.body = "";
  EXPECT_THROW(World{scene_of(recipe)}, InputError);
  recipe = awake(12);
  recipe.body = "";
  EXPECT_NO_THROW(World{scene_of(recipe)});
  Recipe beside = awake(12);
  beside.world +=
      "[[body]]\nname = \"c\"\nshape = \"box\"\nsize_mm = [9, 9, 9]\nspacing_mm = 3\nmaterial = \"m\"\n";
  EXPECT_THROW(World{scene_of(beside)}, InputError);
}

TEST_F(AwakeParts, BeginAnewAfterAReset) {
  World world(scene_of(awake(12)));
  Hand hand;
  const auto loaded = world.state_hash();
  hand.frames(world, 100, 0.1);
  const auto pressed = world.state_hash();
  EXPECT_NE(pressed, loaded);
  world.reset();
  EXPECT_EQ(world.state_hash(), loaded);
  EXPECT_EQ(sleeping(world), 1);
  Hand again;
  again.frames(world, 100, 0.1);
  EXPECT_EQ(world.state_hash(), pressed);
}

TEST_F(AwakeParts, BeginAnewAtRestWhereTheGuardActs) {
  World world(scene_of(awake(12)));
  Hand hand;
  const auto loaded = world.state_hash();
  hand.frames(world, 60, 0.1);
  const Body& body = world.body(0).body();
  for (const Index node : body.nodes())
    if ((body.rest_position(node) - Vec3(0, 0, top)).norm() < 0.003)
      world.body(0).place(node, Vec3(0, 0, NAN), Vec3::Zero());
  world.frame({});
  EXPECT_EQ(world.report().restored, 1);
  EXPECT_TRUE(world.body(0).is_finite());
  EXPECT_EQ(sleeping(world), 1);
  EXPECT_EQ(world.state_hash(), loaded);
  hand.frames(world, 200, 0.1);
  EXPECT_EQ(world.report().restored, 1);
  EXPECT_LT(sleeping(world), 1);
  EXPECT_GT(depth_of(world), 0.001);
  EXPECT_LT(world.ledger().balance_error(), 0.01);
}

TEST_F(AwakeParts, WakeWhereAnotherPlaceIsPressed) {
  World world(scene_of(awake(12)));
  Hand hand;
  hand.frames(world, 200, 0.1, Vec3(-0.03, -0.03, 0));
  const double first = depth_of(world), one = sleeping(world);
  hand.frames(world, 200, 0, Vec3(-0.03, -0.03, 0));
  hand.frames(world, 200, 0.1, Vec3(0.03, 0.03, 0));
  EXPECT_NEAR(depth_of(world), first, 0.03 * first);
  EXPECT_LT(sleeping(world), one);
  hand.frames(world, 400, 0.1, Vec3(0.03, 0.03, 0));
  EXPECT_NEAR(sleeping(world), one, 0.03);
}

}  // namespace
}  // namespace palpate::physics::test
