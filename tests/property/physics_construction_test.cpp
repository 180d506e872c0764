// Tools are built at the angles of the scene, hold together, and a body does the same whichever way its lattice is turned.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <numbers>
#include <random>

#include "common/math/angles.h"
#include "common/math/units.h"
#include "physics_node/body/trim.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/lattice/element_step.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/physics/tool_angles.h"

namespace palpate::physics::test {
namespace {

std::uint64_t random_seed() { return std::random_device{}(); }

std::string degrees(const Vec3& theta, const std::string& more = "") {
  return fmt::format("theta_deg = [{:.17g}, {:.17g}, {:.17g}{}]", deg_from_rad(theta[0]),
                     deg_from_rad(theta[1]), deg_from_rad(theta[2]), more);
}

Vec3 random_angles(Dice& dice) {
  constexpr double pi = std::numbers::pi;
  return {dice.between(-pi, pi), dice.between(-0.49 * pi, 0.49 * pi), dice.between(-pi, pi)};
}

/// Compares angles as turns: -pi is pi.
void expect_angles(const Vec3& measured, const Vec3& given, double tolerance) {
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(std::remainder(measured[a] - given[a], 2 * std::numbers::pi), 0, tolerance)
        << "angle " << a + 1;
}

int fewest_elements(const Lattice& lattice) {
  int fewest = 99;
  for (const Index cell : lattice.masses)
    fewest = std::min(fewest, std::popcount(lattice.mask[static_cast<std::size_t>(cell)]));
  return fewest;
}

bool is_one_piece(Lattice lattice) {
  const auto n = lattice.n_masses();
  keep_largest_part(lattice);
  index_masses(lattice);
  return lattice.n_masses() == n;
}

TEST(Angles, AreThoseOfTheirRotation) {
  const auto seed = random_seed();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  Dice dice(seed);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 theta = random_angles(dice);
    const Eigen::Matrix3d R = rotation_of_angles(theta);
    expect_angles(angles_of_rotation(R), theta, 1e-9);
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(R.determinant(), 1, 1e-14);
  }
  for (const double upright : {0.5 * std::numbers::pi, -0.5 * std::numbers::pi}) {
    const Eigen::Matrix3d R = rotation_of_angles({0.3, upright, 0.2});
    EXPECT_LT((rotation_of_angles(angles_of_rotation(R)) - R).norm(), 1e-9);
  }
}

TEST(Knife, StandsAtTheAnglesOfTheScene) {
  const auto seed = random_seed();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  Dice dice(seed);
  for (int n = 0; n < 50; ++n) {
    const Vec3 theta = random_angles(dice), tip = dice.within(50);
    Recipe recipe;
    recipe.spacing_mm = dice.between(0.5, 3);
    const double length = recipe.spacing_mm * dice.between(2, 20),
                 height = recipe.spacing_mm * dice.between(2, 20);
    recipe.shape =
        fmt::format("shape = \"knife\"\nlength_mm = {}\nheight_mm = {}\n{}", length, height, degrees(theta));
    recipe.body = fmt::format("at_mm = [{}, {}, {}]", tip.x(), tip.y(), tip.z());
    SCOPED_TRACE(fmt::format("{} spacing {}", recipe.shape, recipe.spacing_mm));
    const Body body = body_of(recipe);
    const MeasuredTool tool = measure_knife(body);
    expect_angles(angles_of_rotation(tool.R), theta, 1e-7);
    EXPECT_LT((body.tip - 1e-3 * tip).norm(), 1e-12);
    EXPECT_LT((tool.tip - body.tip).norm(), 1e-9);
    EXPECT_GE(fewest_elements(body.lattice), 3);
    EXPECT_TRUE(is_one_piece(body.lattice));
  }
}

TEST(Needle, StandsAtTheAnglesOfTheScene) {
  const auto seed = random_seed();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  Dice dice(seed);
  for (int n = 0; n < 50; ++n) {
    const Vec3 theta = random_angles(dice), tip = dice.within(50);
    Recipe recipe;
    recipe.spacing_mm = dice.between(0.5, 3);
    const double diameter = recipe.spacing_mm * dice.between(10, 20), sharpening = dice.between(15, 75);
    const double length =
        diameter / std::tan(rad_from_deg(sharpening)) + recipe.spacing_mm * dice.between(3, 10);
    recipe.shape = fmt::format("shape = \"needle\"\nlength_mm = {}\ndiameter_mm = {}\n{}", length, diameter,
                               degrees(theta, fmt::format(", {}", sharpening)));
    recipe.body = fmt::format("at_mm = [{}, {}, {}]", tip.x(), tip.y(), tip.z());
    SCOPED_TRACE(fmt::format("{} spacing {}", recipe.shape, recipe.spacing_mm));
    const Body body = body_of(recipe);
    const MeasuredTool tool = measure_needle(body);
    expect_angles(angles_of_rotation(tool.R), theta, 1e-7);
    EXPECT_LT((tool.tip - body.tip).norm(), 1e-9);
    EXPECT_NEAR(deg_from_rad(tool.sharpening), sharpening, 3) << "as many columns as there are";
    EXPECT_GE(fewest_elements(body.lattice), 3);
    EXPECT_TRUE(is_one_piece(body.lattice));
  }
}

TEST(Needle, IsHollowWhateverItsSize) {
  for (const double diameter : {4.0, 4.3, 5.0, 7.5, 12.0})
    for (const double sharpening : {5.0, 20.0, 45.0, 90.0}) {
      Recipe recipe;
      recipe.spacing_mm = 1;
      recipe.shape =
          fmt::format("shape = \"needle\"\nlength_mm = 160\ndiameter_mm = {}\ntheta_deg = [0, 0, 0, {}]",
                      diameter, sharpening);
      SCOPED_TRACE(recipe.shape);
      const Body body = body_of(recipe);
      EXPECT_TRUE(is_one_piece(body.lattice));
      EXPECT_GE(fewest_elements(body.lattice), 3);
      double low = 1, high = 0, nearest = 1;
      Vec3 axis = Vec3::Zero();
      for (const Index cell : body.handle)
        axis += body.lattice.rest_position(cell) / static_cast<double>(body.handle.size());
      for (const Index cell : body.lattice.masses) {
        const Vec3 p = body.lattice.rest_position(cell);
        low = std::min(low, p.z());
        high = std::max(high, p.z());
        nearest = std::min(nearest, (p - axis).head<2>().norm());
      }
      EXPECT_NEAR(low, 0, 1e-9);
      EXPECT_LE(high, 0.160 + 1e-9);
      EXPECT_GT(high, 0.159);
      EXPECT_GT(nearest, 0.4e-3) << "no mass in the bore";
    }
}

/// A turned body that is shaken in turned directions moves as the other does, turned.
TEST(TurnedLattice, MovesAsTheOtherDoes) {
  const auto seed = random_seed();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  Dice dice(seed);
  const Vec3 theta = random_angles(dice);
  const Eigen::Matrix3d R = rotation_of_angles(theta);
  Recipe recipe;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20\nviscosity_Pa_s = 2";
  const Body plain = body_of(recipe);
  recipe.body = degrees(theta);
  const Body turned = body_of(recipe);
  ASSERT_EQ(plain.lattice.masses, turned.lattice.masses);
  EXPECT_NEAR(turned.law.k1[0] / plain.law.k1[0], 1, 1e-12)
      << "the modulus is that of the lattice, whichever way it lies";
  LatticeState<double> a(plain), b(turned);
  for (const Index cell : plain.lattice.masses) {
    const Vec3 v = dice.within(0.5);
    write(a.v, cell, v);
    write(b.v, cell, R * v);
  }
  for (int n = 0; n < 200; ++n) {
    element_step(plain, a, {.dt = 1e-4});
    element_step(turned, b, {.dt = 1e-4});
  }
  double moved = 0;
  for (const Index cell : plain.lattice.masses) {
    EXPECT_LT((R * plain.lattice.rest_position(cell) - turned.lattice.rest_position(cell)).norm(), 1e-12);
    EXPECT_LT((R * read(a.u, cell) - read(b.u, cell)).norm(), 1e-10);
    moved = std::max(moved, read(a.u, cell).norm());
  }
  EXPECT_GT(moved, 1e-4);
}

}  // namespace
}  // namespace palpate::physics::test
