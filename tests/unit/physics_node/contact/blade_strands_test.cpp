// A scalpel in the bed between two bodies: what it feels is toughness times the length of its edge, what it takes
// toughness times the area of what it has cut, and what the bed holds helps.

#include "physics_node/contact/blade_strands.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/error/error.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/led_blade.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double toughness = 100, side = 0.020, area = side * side;  // of the bed
constexpr double middle = 0.011;                                     // y between the blocks [m]

/// Two blocks of 20 x 20 x 20 mm beside each other in y with a gap of 2 mm, and a blade whose edge is along z and
/// goes to -x.
Recipe bed(const std::string& held = "fixed = [\"+y\"]\n", const std::string& own = "fixed = [\"-y\"]\n",
           double toughness_of_cut = toughness) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(20, 20, 20);
  recipe.spacing_mm = 5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 1000\nviscosity_Pa_s = 50";
  recipe.body = "model = \"fem\"\n" + own;
  recipe.world = fmt::format(
      "[contact]\nenabled = false\n"
      "[[body]]\nname = \"other\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm = 5\nmaterial = \"m\"\n"
      "shape = \"box\"\nsize_mm = [20, 20, 20]\nat_mm = [0, 22, 0]\n{}"
      "[[connection]]\nname = \"bed\"\nfrom = \"other\"\nto = \"body\"\nwithin_mm = 3\nmodulus_kPa = 1\n"
      "cut_toughness_J_per_m2 = {}\n"
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 30\nedge_deg = 0\ndevice = \"hand\"\n"
      "stiffness_N_per_m = 1000\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 30, 11, -15], [1, 20, 11, -15]]\n",
      held, toughness_of_cut);
  return recipe;
}

struct Stroke : LedBlade {
  explicit Stroke(const Recipe& recipe) : LedBlade(recipe, Vec3(0.030, middle, -0.015)) {}
  const Connection& bed() const { return world.connection(0); }
};

/// Between blocks of springs a blade may cut them, too, and here it passes between them.
Recipe bed_between_springs() {
  Recipe recipe = bed();
  recipe.material += "\ncut_toughness_J_per_m2 = 190";
  recipe.body = "fixed = [\"-y\"]\n";
  const std::string fem = "model = \"fem\"\n";
  recipe.world.replace(recipe.world.find(fem), fem.size(), "");
  return recipe;
}

class FeltBed : public testing::TestWithParam<bool> {};

TEST_P(FeltBed, IsFeltAsToughnessTimesLength) {
  Stroke stroke(GetParam() ? bed_between_springs() : bed());
  // Over two whole rows of strands, with as many before the edge as behind.
  stroke.along(Vec3(0.0, middle, -0.015), 0.05);
  const double at_first = stroke.book().cut_area();
  const std::vector<Vec3> steady = stroke.along(Vec3(-0.005, middle, -0.015), 0.05);
  double mean = 0, least = 1e9, most = 0, jump = 0;
  for (std::size_t i = 0; i < steady.size(); ++i) {
    mean += steady[i].x() / static_cast<double>(steady.size());
    least = std::min(least, steady[i].x()), most = std::max(most, steady[i].x());
    if (i > 0) jump = std::max(jump, (steady[i] - steady[i - 1]).norm());
  }
  EXPECT_NEAR(mean, toughness * side, 0.02 * toughness * side);
  EXPECT_NEAR(stroke.book().cut_area() - at_first, 0.005 * side, 0.02 * 0.005 * side);
  EXPECT_GT(least, 0.85 * toughness * side) << "rows at the border are as wide as half of the others";
  EXPECT_LT(most, 1.15 * toughness * side);
  EXPECT_LT(jump, 0.03 * toughness * side) << "of a frame, in 50 um";
}

INSTANTIATE_TEST_SUITE_P(BladeStrands, FeltBed, testing::Bool(), [](const testing::TestParamInfo<bool>& one) {
  return one.param ? "BetweenSprings" : "BetweenElements";
});

TEST(BladeStrands, TakeToughnessTimesAreaHoweverFastTheHand) {
  for (const double speed : {0.01, 0.2, 2.0, 12.0}) {
    Stroke stroke(bed());
    stroke.along(Vec3(-0.030, middle, -0.015), speed);
    EXPECT_EQ(stroke.bed().n_cut(), 25) << speed;
    EXPECT_EQ(stroke.bed().n_torn(), 0);
    EXPECT_NEAR(stroke.book().cut_area(), area, 1e-12) << speed;
    const EnergyLedger ledger = stroke.world.ledger();
    EXPECT_NEAR(ledger.cut, toughness * area, 1e-9) << speed;
    EXPECT_LT(ledger.balance_error(), 1e-3) << speed;
    EXPECT_LT(stroke.world.watched_ledger().balance_error(), 1e-3) << speed;
    EXPECT_NEAR(stroke.book().tissue_work(), ledger.tool_work, 1e-12);
    EXPECT_GE(stroke.book().tissue_work(), toughness * area * (1 - 1e-6) - ledger.broken) << speed;
    EXPECT_EQ(stroke.world.report().restored, 0) << speed;
    EXPECT_EQ(stroke.bed().pull(), 0);
    for (int n = 0; n < 20; ++n) EXPECT_EQ(stroke.to(stroke.path.back()).norm(), 0) << "after the last";
  }
}

/// A bed under tension pays as much as it holds. Its bodies are so heavy that they hardly come nearer meanwhile.
TEST(BladeStrands, ArePaidByWhatTheyHold) {
  constexpr double apart = 0.002;  // 1 kPa x 400 mm^2 / 2 mm x (2 mm)^2 / 2 = 0.4 mJ, 1 J/m^2
  const double held = 0.5 * 1e3 * area / 0.002 * apart * apart;
  for (const double gc : {2.5, 0.4}) {
    Recipe recipe = bed("", "", gc);
    recipe.material = "density_kg_per_m3 = 1e5\nmodulus_kPa = 1000\nviscosity_Pa_s = 50";
    Stroke stroke(recipe);
    BodyModel& other = stroke.world.body(1);
    for (const Index node : other.body().nodes()) other.place(node, Vec3(0, apart, 0), Vec3::Zero());
    stroke.world.restart_ledger();
    for (Vec3& p : stroke.path) p.y() = middle + 0.5 * apart;
    EXPECT_NEAR(stroke.bed().energy(), held, 0.01 * held);
    double most = 0;
    for (const Vec3& force : stroke.along(Vec3(-0.030, middle + 0.5 * apart, -0.015), 12))
      most = std::max(most, force.norm());
    EXPECT_EQ(stroke.bed().n_cut(), 25);
    const EnergyLedger ledger = stroke.world.ledger();
    const double needs = gc * area, paid_by_bed = std::min(held, needs);
    EXPECT_NEAR(ledger.cut, needs, 1e-12);
    EXPECT_NEAR(stroke.book().tissue_work(), needs - paid_by_bed, 0.03 * held) << gc;
    EXPECT_NEAR(ledger.broken, held - paid_by_bed, 0.03 * held) << gc;
    EXPECT_LT(ledger.balance_error(), 1e-3);
    EXPECT_LT(most, 1.15 * std::max(0.0, gc - 1) * side + 1e-9) << gc;
  }
}

/// Masses so light, and tissue so soft, that it gives way by several strands before the first is cut: most slip off
/// the edge.
TEST(BladeStrands, OfTissueThatGivesWayKeepTheBooks) {
  Recipe recipe = bed("fixed = [\"+y\"]\n", "fixed = [\"-y\"]\n", 1000);
  recipe.spacing_mm = 2;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 3\nviscosity_Pa_s = 3";
  const std::string coarse = "spacing_mm = 5";
  recipe.world.replace(recipe.world.find(coarse), coarse.size(), "spacing_mm = 2");
  Stroke stroke(recipe);
  for (const Vec3& force : stroke.along(Vec3(-0.060, middle, -0.015), 0.3))
    EXPECT_LT(force.norm(), 1000 * side);
  const EnergyLedger ledger = stroke.world.ledger();
  EXPECT_NEAR(ledger.cut, 1000 * stroke.book().cut_area(), 1e-9);
  EXPECT_LT(ledger.balance_error(), 0.01);
  EXPECT_EQ(stroke.world.report().restored, 0);
}

TEST(BladeStrands, GetTheImpulseThatTheHandFeels) {
  Stroke stroke(bed("", ""));
  Vec3 impulse = Vec3::Zero();
  for (const Vec3& force : stroke.along(Vec3(-0.010, middle, -0.015), 0.5)) impulse -= 1e-3 * force;
  Momenta momenta = stroke.world.body(0).momenta();
  momenta.linear += stroke.world.body(1).momenta().linear;
  EXPECT_LT(impulse.x(), -1e-3);
  EXPECT_NEAR(momenta.linear.x(), impulse.x(), 0.05 * std::abs(impulse.x()))
      << "force of a frame's last step";
  EXPECT_LT(std::abs(momenta.linear.y()), 1e-9);
  EXPECT_LT(stroke.world.ledger().balance_error(), 5e-3);
}

TEST(BladeStrands, AreNotCutFromBehindNorFromAside) {
  Stroke stroke(bed());
  stroke.along(Vec3(0.030, middle + 0.020, -0.015), 0.5);   // round the bed,
  stroke.along(Vec3(-0.030, middle + 0.020, -0.015), 0.5);  // through a block, which it does not cut
  stroke.along(Vec3(-0.030, middle, -0.015), 0.5);
  for (const Vec3& force : stroke.along(Vec3(0.030, middle, -0.015), 0.5)) EXPECT_EQ(force.norm(), 0);
  EXPECT_EQ(stroke.book().cut_area(), 0) << "its back cuts nothing";
  stroke.along(Vec3(0.030, middle + 0.020, -0.015), 0.5);
  stroke.along(Vec3(-0.011, middle + 0.020, -0.015), 0.5);
  stroke.along(Vec3(-0.011, middle, -0.015), 0.5);  // it comes from aside, all but beyond the bed
  EXPECT_LT(stroke.book().cut_area(), 0.1 * area);
}

/// A blade that comes into a patch from aside presses on nothing until it is moved ahead.
TEST(BladeStrands, DoNotPressABladeThatComesFromAside) {
  for (const double x : {-0.001, 0.0015, 0.004, 0.0075}) {
    Stroke stroke(bed());
    stroke.along(Vec3(0.030, middle + 0.020, -0.015), 0.5);
    stroke.along(Vec3(x, middle + 0.020, -0.015), 0.5);
    for (const Vec3& force : stroke.along(Vec3(x, middle - 0.020, -0.015), 0.1))
      EXPECT_EQ(force.norm(), 0) << x;
    EXPECT_EQ(stroke.book().cut_area(), 0) << x;
  }
}

/// A blade lifted out of a cut half done holds nothing any more.
TEST(BladeStrands, AreLetGoWhenTheBladeLeavesTheGap) {
  Stroke stroke(bed());
  stroke.along(Vec3(-0.0025, middle, -0.015), 0.05);
  stroke.along(Vec3(-0.0025, middle + 0.020, -0.015), 0.05);
  const double cut = stroke.book().cut_area();
  for (const Vec3& force : stroke.along(Vec3(-0.030, middle + 0.020, -0.015), 0.05))
    EXPECT_EQ(force.norm(), 0);
  EXPECT_EQ(stroke.book().cut_area(), cut);
}

/// A hand so soft that it is far ahead of the edge.
TEST(BladeStrands, AreCutByASoftHandAllTheSame) {
  Recipe recipe = bed();
  const std::string stiff = "stiffness_N_per_m = 1000";
  recipe.world.replace(recipe.world.find(stiff), stiff.size(), "stiffness_N_per_m = 50");
  Stroke stroke(recipe);
  stroke.along(Vec3(-0.090, middle, -0.015), 0.1);
  EXPECT_EQ(stroke.bed().n_cut(), 25);
  EXPECT_LT(stroke.world.ledger().balance_error(), 1e-3);
}

/// A blade inclined by 20 degrees that goes straight on slides along the strands: the work of the hand is what is cut.
TEST(BladeStrands, PushAnInclinedBladeAside) {
  Recipe recipe = bed();
  const std::string upright = "edge_deg = 0";
  recipe.world.replace(recipe.world.find(upright), upright.size(), "edge_deg = 0\ntheta_deg = [20, 0, 0]");
  Stroke stroke(recipe);
  double work = 0, aside = 0;
  Vec3 last = stroke.path.back();
  for (int n = 1; n <= 1000; ++n) {
    const Vec3 tip(0.030 - 60e-6 * n, middle, -0.015);
    const Vec3 force = stroke.to(tip);
    work -= force.dot(tip - last);
    aside = std::max(aside, std::abs(force.y()));
    last = tip;
  }
  EXPECT_GT(stroke.book().cut_area(), 0.1 * area);
  EXPECT_GT(aside, 0.1 * toughness * side);
  EXPECT_NEAR(work, stroke.book().tissue_work(), 0.05 * work);
}

TEST(BladeStrands, GoOnWhereTheyWereHalfCut) {
  Stroke stroke(bed());
  stroke.along(Vec3(-0.0025, middle, -0.015), 0.05);  // 2 N lie behind by 2 mm
  const double half = stroke.book().cut_area();
  EXPECT_NEAR(half, 0.5 * area, 0.1 * area);
  for (const Vec3& force : stroke.along(Vec3(0.030, middle, -0.015), 0.05))
    EXPECT_GE(force.x(), 0) << "it pulls";
  const std::vector<Vec3> again = stroke.along(Vec3(0.002, middle, -0.015), 0.05);
  for (const Vec3& force : again) EXPECT_EQ(force.norm(), 0) << "in its own slot";
  EXPECT_NEAR(stroke.book().cut_area(), half, 1e-4 * half);
  stroke.along(Vec3(-0.030, middle, -0.015), 0.05);
  EXPECT_NEAR(stroke.book().cut_area(), area, 1e-12);
}

TEST(BladeStrands, AreCutTheSameOnAnyNumberOfThreadsAndAfterAReset) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3}) {
    Recipe recipe = bed();
    recipe.physics = fmt::format("threads = {}", threads);
    Stroke stroke(recipe);
    const std::uint64_t loaded = stroke.world.state_hash();
    stroke.along(Vec3(0.0, middle, -0.015), 0.2);
    const std::uint64_t cut = stroke.world.state_hash();
    if (first == 0) first = cut;
    EXPECT_EQ(cut, first) << threads;
    EXPECT_NE(cut, loaded);
    stroke.world.reset();
    EXPECT_EQ(stroke.world.state_hash(), loaded);
    EXPECT_EQ(stroke.bed().n_cut(), 0);
  }
}

TEST(BladeStrands, MustSayHowToughTheyAre) {
  Recipe untold = bed();
  const std::string key = "cut_toughness_J_per_m2 = 100\n";
  untold.world.replace(untold.world.find(key), key.size(), "");
  try {
    World world(scene_of(untold));
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("how tough connection \"bed\" is"));
    EXPECT_THAT(error.what(), testing::HasSubstr("cut_toughness_J_per_m2"));
  }
}

}  // namespace
}  // namespace palpate::physics::test
