// A rigid needle in finite elements: it enters at the puncture ratio times toughness times its diameter, goes on at
// that, rubs by its depth, finds open what it has opened, and is held across.

#include "physics_node/contact/needle_tool.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "common/error/error.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/led_blade.h"
#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double toughness = 164, diameter = 0.0012, friction = 15, ratio = 1.5;  // [J/m^2], [m], [N/m]
constexpr double goes_on = toughness * diameter;                                  // [N]
constexpr double top = 0.015;                                                     // of the block [m]

struct Case {
  const char* model = "fem";
  double cell_mm = 2, speed = 0.05;
  const char* precision = "double";
  int modulus_kPa = 60;
};

std::string tool(double rubs = friction) {
  return fmt::format(
      "[[tool]]\nname = \"needle\"\nshape = \"needle\"\nrigid = true\nlength_mm = 60\ndiameter_mm = {}\n"
      "friction_N_per_m = {}\ndevice = \"hand\"\nstiffness_N_per_m = 1000\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 25], [1, 0, 0, 25]]\n",
      1e3 * diameter, rubs);
}

Recipe block(const Case& c = {}, const std::string& body = "fixed = [\"-z\", \"-x\", \"+x\"]") {
  Recipe recipe;
  if (c.model == std::string("fem")) {
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(30, 30, 30);
    recipe.spacing_mm = c.cell_mm;
    recipe.body = "model = \"fem\"\n";
  } else {
    const int n = static_cast<int>(std::lround(30 / c.cell_mm));
    recipe = mesh_box({n, n, n}, 1e-3 * c.cell_mm, "nodal_pressure");
  }
  recipe.body += "at_mm = [0, 0, 0]\n" + body;
  recipe.material = fmt::format(
      "density_kg_per_m3 = 1000\nmodulus_kPa = {}\npoisson_ratio = 0.45\nviscosity_Pa_s = 2\n"
      "cut_toughness_J_per_m2 = {}\n",
      c.modulus_kPa, toughness);
  recipe.physics = "frame_Hz = 1000";
  recipe.precision = c.precision;
  recipe.world = tool();
  return recipe;
}

const Vec3 above(0.0003, 0.0007, top + 0.003);
Vec3 at_depth(double depth) { return {above.x(), above.y(), top - depth}; }

struct Needle : LedBlade {
  explicit Needle(const Recipe& recipe, const Vec3& start = above) : LedBlade(recipe, start) {}
  /// Mean and greatest force on the hand along +z.
  struct Way {
    double mean = 0, most = -1e9, jump = 0;
  };
  Way way(const Vec3& end, double speed) {
    Way of;
    const std::vector<Vec3> forces = along(end, speed);
    for (std::size_t n = 0; n < forces.size(); ++n) {
      of.mean += forces[n].z() / static_cast<double>(forces.size());
      of.most = std::max(of.most, forces[n].z());
      if (n > 0) of.jump = std::max(of.jump, (forces[n] - forces[n - 1]).norm());
    }
    return of;
  }
};

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

/// What the hand does goes into the crack, into friction and into tissue, and nowhere else.
TEST(Needle, SpendsWhatTheHandDoes) {
  Needle needle(block());
  double work = 0;
  Vec3 before = needle.path.back(), force = Vec3::Zero();
  for (const double depth : {0.016, 0.006, 0.019, -0.003}) {
    const Vec3 begin = needle.path.back(), end = at_depth(depth);
    const int n = 200;
    for (int i = 1; i <= n; ++i) {
      const Vec3 at = begin + (end - begin) * i / n, now = needle.to(at);
      work -= 0.5 * (now + force).dot(at - before);
      before = at, force = now;
    }
  }
  EXPECT_TRUE(force.isZero(0)) << "nothing is left in springs";
  const double spent = needle.book().tissue_work() + needle.book().rubbed();
  EXPECT_GT(needle.book().rubbed(), 0.1 * work);
  EXPECT_NEAR(spent, work, 0.03 * work);
}

/// Led aside in tissue, it takes that along: the hand is held across, on every side alike, and less where tissue is
/// softer.
TEST(Needle, IsHeldAcross) {
  const auto held = [](int modulus_kPa, const Vec3& way) {
    Needle needle(block({.modulus_kPa = modulus_kPa}));
    const Vec3 deep = at_depth(0.020);
    needle.along(deep, 0.05);
    needle.along(deep + way, 0.02);
    const std::vector<Vec3> rest(needle.path.end() - 1, needle.path.end());
    Vec3 force;
    for (int n = 0; n < 100; ++n) force = needle.to(rest.front());
    EXPECT_EQ(needle.world.report().restored, 0);
    EXPECT_GT(needle.world.report().least_corner_J, 0.2);
    return Vec3(-force);
  };
  const Vec3 stiff = held(60, Vec3(0, 0.002, 0)), soft = held(15, Vec3(0, 0.002, 0)),
             other = held(60, Vec3(0, -0.002, 0));
  EXPECT_GT(stiff.y(), 0.2);
  EXPECT_NEAR(other.y(), -stiff.y(), 0.1 * stiff.y());
  EXPECT_LT(soft.y(), 0.6 * stiff.y());
  EXPECT_LT(std::abs(stiff.x()), 0.05 * stiff.y());
}

/// How it dents tissue before it enters, and how that holds it across, is of the tissue and not of its cells.
TEST(Needle, DentsAndIsHeldAlikeOnAnyCells) {
  for (const double modulus : {20e3, 60e3}) {
    std::vector<double> dents, across;
    for (const double cell : {1.5, 2.0, 3.0}) {
      Needle needle(block({.cell_mm = cell, .modulus_kPa = static_cast<int>(1e-3 * modulus)}));
      double dent = 0, force = 0;
      while (needle.book().punctures() == 0 && dent < 0.02) {
        force = needle.to(needle.path.back() - Vec3(0, 0, 2e-5)).z();
        dent = top - needle.path.back().z() - force / 1000;
      }
      dents.push_back(dent);
      needle.along(at_depth(0.020), 0.05);
      needle.along(at_depth(0.020) + Vec3(0, 0.001, 0), 0.02);
      Vec3 held;
      for (int n = 0; n < 100; ++n) held = needle.to(needle.path.back());
      across.push_back(-held.y());
    }
    const NearNeedle thick{
        .modulus = modulus, .poisson_ratio = 0.45, .radius = 0.5 * diameter, .reach = 0.004};
    for (std::size_t n = 0; n < dents.size(); ++n) {
      EXPECT_NEAR(dents[n], thick.dent(ratio * goes_on), 0.12 * dents[n]) << n << " " << modulus;
      EXPECT_NEAR(across[n], across[0], 0.12 * across[0]) << n << " " << modulus;
    }
  }
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

/// Barely in, and led aside: it ploughs on at what tissue bears, and the hand pays for it.
TEST(Needle, PloughsWhereItIsShallow) {
  Needle needle(block());
  needle.along(at_depth(0.006), 0.05);
  needle.along(at_depth(0.003), 0.05);
  const double opened = needle.book().cut_area();
  needle.along(at_depth(0.003) + Vec3(0, 0.010, 0), 0.05);
  EXPECT_GT(needle.book().cut_area(), opened + 3e-6);
  EXPECT_LT(needle.world.tool(0).borne().norm(), ratio * toughness * (0.003 + diameter) * 1.2);
  EXPECT_EQ(needle.world.report().restored, 0);
}

TEST(Needle, LetsGoWithTheHand) {
  Needle needle(block());
  needle.along(at_depth(0.012), 0.05);
  std::optional<ToolState> none;
  for (int n = 0; n < 600; ++n) needle.world.frame(std::span(&none, 1));
  EXPECT_LT(needle.world.tool(0).borne().norm(), 1e-12);
}

/// A handle that whirls round in tissue tears it open rather than turning it inside out.
TEST(Needle, SurvivesAHandleThatWhirls) {
  Needle needle(block({.modulus_kPa = 15}));
  needle.along(at_depth(0.020), 0.05);
  for (int n = 0; n < 200; ++n) {
    needle.path.push_back(at_depth(0.020));
    std::optional<ToolState> hand =
        recorded_hand([&](double) { return at_depth(0.020); }, needle.path.size() - 1);
    const double half = 0.5 * 0.02 * n;
    hand->q_WT = {std::cos(half), std::sin(half), 0, 0};
    needle.world.frame(std::span(&hand, 1));
  }
  EXPECT_TRUE(needle.world.body(0).is_finite());
  EXPECT_EQ(needle.world.report().restored, 0);
  EXPECT_LT(needle.world.tool(0).borne().norm(), 20);
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
