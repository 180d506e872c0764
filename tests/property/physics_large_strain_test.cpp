// Hexahedra under large strain: against closed forms of their law, twisted and squeezed, and back.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/solids/driven_body.h"
#include "bench/solids/hex_block.h"
#include "physics_node/material/lame.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::bench {
namespace {

using physics::Lame;
using physics::test::Recipe;

constexpr double modulus = 10e3;

/// A bar of stable neo-Hookean tissue, drawn to the stretch l and free across: P_tt = 0 gives the stretch across, t, and with it the
/// stress per area at rest,
///   t^2 = [1 + mu/(lambda + mu) (1 - 1/l)]/l,   P = mu (l - t^2/l)
struct Drawn {
  Drawn(double l, double nu) {
    const Lame lame = physics::lame_of(modulus, nu);
    const double t2 = (1 + lame.mu / (lame.lambda + lame.mu) * (1 - 1 / l)) / l;
    across = std::sqrt(t2);
    stress = lame.mu * (l - t2 / l);
  }
  double across, stress;
};

constexpr double stretches[] = {0.6, 0.75, 0.9, 1.2, 2, 3};
constexpr double ratios[] = {0.3, 0.45, 0.49};
const Vec3 flat_edge(0.003, 0.002, 0.0025);

/// Held on the three planes through the origin; z of the upper face led in ten parts.
HexBlock drawn_block(const std::array<int, 3>& cells, double l, double nu) {
  HexBlock block(cells, flat_edge, {.modulus = modulus, .poisson_ratio = nu});
  const double height = cells[2] * flat_edge.z();
  for (int part = 1; part <= 10; ++part) {
    for (int n = 0; n < block.n_nodes(); ++n) {
      const Vec3 u = block.displacement(n);
      block.place(n, {u.x(), u.y(), 0.1 * part * (l - 1) * block.rest(n).z()});
      for (int axis = 0; axis < 3; ++axis)
        if (block.rest(n)[axis] < 1e-9) block.hold(n, axis);
      if (block.rest(n).z() > height - 1e-9) block.hold(n, 2, 0.1 * part * (l - 1) * height);
    }
    EXPECT_TRUE(block.solve()) << "stretch " << l << ", nu " << nu;
  }
  return block;
}

TEST(LargeStrain, DrawsOneCellAndABarAsTheClosedFormSays) {
  for (const double nu : ratios)
    for (const double l : stretches)
      for (const std::array<int, 3>& cells : {std::array{1, 1, 1}, std::array{2, 2, 5}}) {
        const HexBlock bar = drawn_block(cells, l, nu);
        const Vec3 size = flat_edge.cwiseProduct(Vec3(cells[0], cells[1], cells[2]));
        const Drawn expected(l, nu);
        double force = 0;
        for (int n = 0; n < bar.n_nodes(); ++n) {
          if (bar.rest(n).z() > size.z() - 1e-9) force -= bar.force(n).z();
          for (int axis = 0; axis < 2; ++axis)
            EXPECT_NEAR(bar.rest(n)[axis] + bar.displacement(n)[axis], expected.across * bar.rest(n)[axis],
                        1e-6 * size[axis]);
        }
        EXPECT_NEAR(force / (size.x() * size.y()), expected.stress, 1e-6 * modulus)
            << "stretch " << l << ", nu " << nu;
      }
}

/// Nothing moves across: P = (lambda + 2 mu)(l - 1) along, [mu + (lambda + mu)(l - 1) l - mu l] across.
TEST(LargeStrain, SqueezesInAChamberAsTheClosedFormSays) {
  for (const double nu : ratios)
    for (const double l : {0.3, 0.6, 0.9, 1.5}) {
      const Lame lame = physics::lame_of(modulus, nu);
      HexBlock block({2, 2, 3}, flat_edge, {.modulus = modulus, .poisson_ratio = nu});
      const Vec3 size = flat_edge.cwiseProduct(Vec3(2, 2, 3));
      for (int n = 0; n < block.n_nodes(); ++n)
        for (int axis = 0; axis < 3; ++axis) {
          const bool low = block.rest(n)[axis]<1e-9, high = block.rest(n)[axis]> size[axis] - 1e-9;
          if (low || high) block.hold(n, axis, high && axis == 2 ? (l - 1) * size.z() : 0);
        }
      EXPECT_TRUE(block.solve());
      double along = 0, across = 0;
      for (int n = 0; n < block.n_nodes(); ++n) {
        EXPECT_NEAR(block.displacement(n).z(), (l - 1) * block.rest(n).z(), 1e-7 * size.z());
        if (block.rest(n).z() > size.z() - 1e-9) along -= block.force(n).z();
        if (block.rest(n).x() > size.x() - 1e-9) across -= block.force(n).x();
      }
      EXPECT_NEAR(along / (size.x() * size.y()), (lame.lambda + 2 * lame.mu) * (l - 1), 1e-6 * modulus);
      EXPECT_NEAR(across / (size.y() * size.z()), lame.mu + ((lame.lambda + lame.mu) * (l - 1) - lame.mu) * l,
                  1e-6 * modulus);
    }
}

/// u_x = g z: P_xz = P_zx = mu g and no normal stress, whatever g is.
TEST(LargeStrain, ShearsAsTheClosedFormSays) {
  for (const double nu : ratios)
    for (const double g : {0.2, 1.0, 2.0}) {
      HexBlock block({3, 2, 3}, flat_edge, {.modulus = modulus, .poisson_ratio = nu});
      const Vec3 size = flat_edge.cwiseProduct(Vec3(3, 2, 3));
      for (int n = 0; n < block.n_nodes(); ++n) {
        const Vec3& x = block.rest(n);
        const bool on_face = x.minCoeff() < 1e-9 || (size - x).minCoeff() < 1e-9;
        for (int axis = 0; on_face && axis < 3; ++axis) block.hold(n, axis, axis == 0 ? g * x.z() : 0);
      }
      EXPECT_TRUE(block.solve());
      Vec3 top = Vec3::Zero();
      for (int n = 0; n < block.n_nodes(); ++n) {
        const Vec3& x = block.rest(n);
        EXPECT_NEAR(block.displacement(n).x(), g * x.z(), 1e-7 * size.z());
        if (x.z() > size.z() - 1e-9) top -= block.force(n);
      }
      const double sheared = physics::lame_of(modulus, nu).mu * g * size.x() * size.y();
      EXPECT_LT((top - sheared * Vec3::UnitX()).norm(), 1e-6 * sheared);
    }
}

Recipe bar_recipe(double x_mm, double y_mm, double z_mm, double cell_mm, double nu, const char* precision) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(x_mm, y_mm, z_mm);
  recipe.spacing_mm = cell_mm;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = " + std::to_string(nu);
  recipe.body = "model = \"fem\"";
  recipe.precision = precision;
  return recipe;
}

DrivenBody driven(const Recipe& recipe) {
  return DrivenBody(physics::test::body_of(recipe),
                    recipe.precision == "double" ? Precision::double_ : Precision::single_);
}

/// The same bar as the product steps it, its ends led.
TEST(LargeStrain, DrawsTheBodyAsTheClosedFormSays) {
  for (const double nu : {0.45, 0.49})
    for (const double l : {0.6, 2.0}) {
      DrivenBody bar = driven(bar_recipe(20, 20, 30, 5, nu, "double"));
      const auto top = [](const Vec3& x) { return x.z() > 0.0149; };
      bar.drive([&](const Vec3& x) -> unsigned {
        return (top(x) || x.z() < -0.0149 ? 4U : 0U) | (std::abs(x.x()) < 1e-6 ? 1U : 0U) |
               (std::abs(x.y()) < 1e-6 ? 2U : 0U);
      });
      constexpr double seconds = 0.2;
      bar.run(seconds, [&](const Vec3& x, double t) { return Vec3(0, 0, (l - 1) * t / seconds * x.z()); });
      EXPECT_TRUE(bar.settle());
      const Drawn expected(l, nu);
      for (const physics::Index node : bar.model().body().nodes()) {
        const Vec3 rest = bar.model().body().rest_position(node);
        EXPECT_LT((bar.model().position(node) - Vec3(expected.across, expected.across, l).cwiseProduct(rest))
                      .norm(),
                  1e-4 * 0.03);
      }
      EXPECT_NEAR(bar.force(top).z() / (0.02 * 0.02), expected.stress, 1e-3 * std::abs(expected.stress))
          << "stretch " << l << ", nu " << nu;
    }
}

/// Root mean square of what nodes are away from the rest shape, wherever that is now.
double away_from_rest(const DrivenBody& body) { return body.model().counts().shape_rms; }

TEST(LargeStrain, TwistsABarByAWholeTurnAndBack) {
  for (const double nu : {0.45, 0.49}) {
    constexpr double half = 0.04, seconds = 0.3;  // of its length
    DrivenBody bar = driven(bar_recipe(20, 20, 80, 5, nu, "single"));
    bar.drive([](const Vec3& x) { return std::abs(x.z()) > half - 1e-6 ? 7U : 0U; });
    bar.run(seconds, [](const Vec3& x, double t) {
      const Eigen::AngleAxisd turn(std::copysign(std::numbers::pi * t / seconds, x.z()), Vec3::UnitZ());
      return Vec3(turn * x - x);
    });
    EXPECT_TRUE(bar.settle(1e-9, 40000));
    const double moment = bar.moment(Vec3::Zero(), [](const Vec3& x) { return x.z() > 0; }).z();
    std::printf("nu %.2f: a whole turn takes %.2f N mm, least J of a corner %.3f\n", nu, 1e3 * moment,
                bar.least_corner_J());
    EXPECT_GT(bar.least_corner_J(), 0.5);
    bar.drive([](const Vec3& x) { return x.z() < -half + 1e-6 ? 7U : 0U; });
    EXPECT_TRUE(bar.settle(1e-9, 40000));
    std::printf("away by %.2g mm\n", 1e3 * away_from_rest(bar));
    EXPECT_LT(away_from_rest(bar), 5e-5);
  }
}

/// Between plates that come together to half the height of the block: bonded to it, or smooth. What bulges meets the plates, too: at the
/// edge of a bonded plate the side of the block rolls onto it, so that corners of cells there fold whatever the element.
TEST(LargeStrain, ComesBackFromHalfItsHeightBetweenPlates) {
  for (const bool bonded : {true, false})
    for (const double nu : {0.45, 0.49}) {
      constexpr double half = 0.015, seconds = 0.3;
      DrivenBody block = driven(bar_recipe(30, 30, 30, 3, nu, "single"));
      double plate = half;  // height of the upper one; the lower comes to meet it
      block.after_step = [&](double dt) {
        for (const physics::Index node : block.model().body().nodes()) {
          const double z = block.model().position(node).z(), in = std::abs(z) - plate;
          if (in <= 0 || std::abs(block.model().body().rest_position(node).z()) > half - 1e-6) continue;
          const physics::NodalPush push{node, Vec3(0, 0, -std::copysign(in / dt, z))};
          block.model().push({&push, 1}, dt);
        }
      };
      const auto axes_of = [bonded](const Vec3& x) {
        const unsigned middle = (std::abs(x.x()) < 1e-6 ? 1U : 0U) | (std::abs(x.y()) < 1e-6 ? 2U : 0U);
        return std::abs(x.z()) < half - 1e-6 ? 0U : bonded ? 7U : 4U | middle;
      };
      block.drive(axes_of);
      block.run(seconds, [&](const Vec3& x, double t) {
        plate = (1 - 0.5 * t / seconds) * half;
        return Vec3(0, 0, -0.5 * t / seconds * x.z());
      });
      EXPECT_TRUE(block.settle(1e-7));
      const double force = -block.force([](const Vec3& x) { return x.z() > 0; }).z();
      const double squeezed = block.least_corner_J();
      if (!bonded) {
        const double expected = -Drawn(0.5, nu).stress * 0.03 * 0.03;
        EXPECT_NEAR(force, expected, 1e-3 * expected);
        EXPECT_GT(squeezed, 0.85);
      }
      plate = 1;
      block.drive([&](const Vec3& x) { return x.z() < 0 ? axes_of(x) : 0U; });
      EXPECT_TRUE(block.settle(1e-9, 40000));
      std::printf("nu %.2f, %s: %.3f N at half its height, least J of a corner %.3f; comes back to %.2g mm\n",
                  nu, bonded ? "bonded" : "smooth", force, squeezed, 1e3 * away_from_rest(block));
      EXPECT_TRUE(block.model().is_finite());
      EXPECT_LT(away_from_rest(block), 2e-5);
    }
}

}  // namespace
}  // namespace palpate::bench
