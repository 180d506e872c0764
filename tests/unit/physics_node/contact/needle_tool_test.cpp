// A rigid needle in finite elements: it enters at the puncture ratio times toughness times its diameter, goes on at
// that, rubs by its depth, and finds open what it has opened.

#include "physics_node/contact/needle_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error/error.h"
#include "common/math/six.h"
#include "tests/unit/physics_node/contact/led_needle.h"

namespace palpate::physics::test {
namespace {

class NeedleIn : public testing::TestWithParam<Case> {};

/// Without friction, as that strains soft tissue more and more on the way down.
TEST_P(NeedleIn, FeelsToughnessTimesDiameter) {
  const Case c = GetParam();
  Recipe recipe = block(c);
  recipe.world = tool(0);
  Needle needle(recipe);
  const Needle::Way entry = needle.way(at_depth(0.009), c.speed);
  EXPECT_EQ(needle.book().punctures(), 1);
  EXPECT_NEAR(needle.book().puncture_force(), ratio * goes_on, 0.02 * ratio * goes_on);
  EXPECT_GE(entry.most, 0.95 * needle.book().puncture_force());
  needle.way(at_depth(0.011), c.speed);
  const double from = needle.book().deepest();
  const double lost = needle.world.ledger().dissipated;
  const Needle::Way steady = needle.way(at_depth(0.021), c.speed);
  const double to = needle.book().deepest(), viscous = (needle.world.ledger().dissipated - lost) / 0.010;
  EXPECT_NEAR(to - from, 0.010, 0.0005);
  EXPECT_NEAR(steady.mean - viscous, goes_on, 0.04 * goes_on);
  EXPECT_LT(steady.jump, 0.12 * goes_on) << "of a frame";
  const TouchBook& book = needle.book();
  EXPECT_NEAR(book.cut_area(), diameter * to, 0.02 * diameter * to);
  const EnergyLedger ledger = needle.world.ledger();
  EXPECT_NEAR(ledger.cut, toughness * book.cut_area(), 1e-9);
  EXPECT_LT(ledger.balance_error(), 2e-3);
  EXPECT_EQ(needle.world.report().restored, 0);
  EXPECT_GT(needle.world.report().least_corner_J, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Tissue, NeedleIn,
                         testing::Values(Case{}, Case{"fem", 3}, Case{"fem", 2, 0.005}, Case{"fem", 2, 0.2},
                                         Case{"fem", 2, 0.05, "single"}, Case{"fem", 2, 0.05, "double", 15},
                                         Case{"mesh", 3}),
                         [](const testing::TestParamInfo<Case>& one) { return std::to_string(one.index); });

/// Drawn back it only rubs, the other way; in its own channel it rubs, and cuts again beyond.
TEST(Needle, FindsItsChannelOpen) {
  Needle needle(block());
  needle.way(at_depth(0.016), 0.05);
  const double deep = needle.book().deepest(), cut = needle.book().cut_area();
  needle.way(at_depth(0.013), 0.05);
  const Needle::Way back = needle.way(at_depth(0.007), 0.05);
  EXPECT_NEAR(back.mean, -friction * (deep - 0.006), 0.2 * friction * deep);
  needle.way(at_depth(0.008), 0.05);
  const Needle::Way again = needle.way(at_depth(0.012), 0.05);
  EXPECT_NEAR(again.mean, friction * (deep - 0.006), 0.2 * friction * deep);
  EXPECT_NEAR(needle.book().cut_area(), cut, 0.02 * cut);
  needle.way(at_depth(0.020), 0.05);
  EXPECT_NEAR(needle.book().cut_area(), cut + 0.004 * diameter, 0.1 * cut);
  EXPECT_EQ(needle.book().punctures(), 1);
  needle.way(above, 0.05);
  EXPECT_LT(needle.to(above).norm(), 1e-12) << "out of it";
  needle.way(at_depth(0.010), 0.05);
  EXPECT_EQ(needle.book().punctures(), 2) << "it is another channel";
}

/// Where entering takes no more than going on, soft tissue before the tip is not only pressed together.
TEST(Needle, GoesOnWhereItHasEntered) {
  Recipe recipe = block({.cell_mm = 3, .modulus_kPa = 10});
  recipe.world = tool(0);
  recipe.material += "puncture_ratio = 1\n";
  Needle needle(recipe);
  const Needle::Way way = needle.way(at_depth(0.018), 0.05);
  EXPECT_EQ(needle.book().punctures(), 1);
  EXPECT_LT(way.most, 1.3 * goes_on);
  EXPECT_GT(needle.book().deepest(), 0.009);
}

/// What the hand does goes into the crack, into friction and into tissue, and nowhere else.
TEST(Needle, SpendsWhatTheHandDoes) {
  Needle needle(block());
  double work = 0;
  for (const double depth : {0.016, 0.006, 0.019, -0.003}) work += needle.work_to(at_depth(depth), 0.075);
  EXPECT_TRUE(needle.force.isZero(0)) << "nothing is left in springs";
  const double spent = needle.book().tissue_work() + needle.book().rubbed();
  EXPECT_GT(needle.book().rubbed(), 0.1 * work);
  EXPECT_NEAR(spent, work, 0.03 * work);
}

/// On its way it is the same force however far the hand goes on; standing, it is a spring.
TEST(Needle, TellsTheHandThatItSlips) {
  Needle needle(block());
  const auto stiffness = [&] {
    ToolWrench wrench;
    needle.world.tool(0).write_wrench(wrench, 0, 0, 0);
    return Eigen::Map<const Mat6>(wrench.stiffness.data()).topLeftCorner<3, 3>().eval();
  };
  needle.along(at_depth(0.016), 0.05);
  EXPECT_LT(stiffness()(2, 2), 0.2 * stiffness()(1, 1));
  EXPECT_GT(stiffness()(1, 1), 300);
  needle.along(at_depth(0.0159), 0.05);
  EXPECT_GT(stiffness()(2, 2), 0.5 * stiffness()(1, 1)) << "it sticks";
}

/// Out of a free body and back: mass, momentum and angular momentum stay to rounding.
TEST(Needle, LosesNothing) {
  Needle needle(block({.cell_mm = 3}, ""));
  needle.along(at_depth(0.010), 0.5);
  needle.along(at_depth(0.010) + Vec3(0.002, 0, 0), 0.5);
  EXPECT_EQ(needle.book().punctures(), 1);
  const MomentumBalance balance = needle.world.body(0).momentum_balance();
  EXPECT_LT(balance.missing.linear.norm(), 1e-11 * balance.linear);
  EXPECT_LT(balance.missing.angular.norm(), 1e-11 * balance.angular);
  EXPECT_LT(needle.world.ledger().balance_error(), 2e-3);
}

TEST(Needle, GoesTheSameWayAgain) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    Recipe recipe = block({.cell_mm = 3});
    recipe.physics += fmt::format("\nthreads = {}", threads);
    Needle needle(recipe);
    const std::uint64_t whole = needle.world.state_hash();
    needle.along(at_depth(0.015), 0.2);
    hashes.push_back(needle.world.state_hash());
    EXPECT_NE(hashes.back(), whole);
    needle.world.reset();
    EXPECT_EQ(needle.world.state_hash(), whole);
    needle.path.assign(2, above);
    needle.along(at_depth(0.015), 0.2);
    EXPECT_EQ(needle.world.state_hash(), hashes[0]) << "as if nothing had been";
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

/// Through a wall, over a gap, through another: it enters twice, and rubs on both.
TEST(Needle, ComesOutAndInAgain) {
  Recipe recipe = block();
  recipe.body += "\n[[body.cavity]]\nbox_min_mm = [-11, -11, -5]\nbox_max_mm = [11, 11, 5]\n";
  Needle needle(recipe);
  needle.along(at_depth(0.014), 0.05);
  EXPECT_EQ(needle.book().punctures(), 1);
  const Vec3 between = needle.to(at_depth(0.014));
  EXPECT_LT(between.z(), 0.9 * goes_on) << "nothing is before the tip";
  needle.along(at_depth(0.026), 0.05);
  EXPECT_EQ(needle.book().punctures(), 2);
  EXPECT_NEAR(needle.book().deepest(), 0.010 + 0.006, 0.003);
  needle.along(above, 0.1);
  EXPECT_LT(needle.to(above).norm(), 1e-12);
  EXPECT_EQ(needle.world.report().restored, 0);
}

/// All of it in tissue it goes no deeper: the hand presses on its hub.
TEST(Needle, StopsAtItsHub) {
  Recipe recipe = block();
  recipe.world.replace(recipe.world.find("length_mm = 60"), 14, "length_mm = 12");
  Needle needle(recipe);
  needle.along(at_depth(0.014), 0.05);
  const double deep = needle.book().deepest();
  const Vec3 force = needle.along(at_depth(0.020), 0.05).back();
  EXPECT_LT(needle.book().deepest(), deep + 0.001);
  EXPECT_GT(force.z(), 2 * (goes_on + friction * deep));
  EXPECT_EQ(needle.world.report().restored, 0);
}

TEST(Needle, LetsGoWithTheHand) {
  Needle needle(block());
  needle.along(at_depth(0.012), 0.05);
  std::optional<ToolState> none;
  for (int n = 0; n < 600; ++n) needle.world.frame(std::span(&none, 1));
  EXPECT_LT(needle.world.tool(0).borne().norm(), 1e-12);
}

std::string refusal(const Recipe& recipe) {
  try {
    const World world(scene_of(recipe));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Needle, RefusesWhatItCannotPierce) {
  Recipe springs = block();
  springs.body = "fixed = [\"-z\"]";
  springs.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 60\ncut_toughness_J_per_m2 = 100";
  EXPECT_THAT(refusal(springs), testing::HasSubstr("model = \"fem\""));
  Recipe untold = block();
  untold.material.resize(untold.material.find("cut_toughness"));
  EXPECT_THAT(refusal(untold), testing::HasSubstr("cut_toughness_J_per_m2"));
  Recipe breaks = block();
  breaks.material += "break_ratio = 1.5\n";
  EXPECT_THAT(refusal(breaks), testing::HasSubstr("break_ratio"));
}

}  // namespace
}  // namespace palpate::physics::test
