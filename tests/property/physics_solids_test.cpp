// Hexahedra against closed forms of linear elasticity: a tube under pressure, a twisted bar, a bent one of flat cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "bench/problems/hex_beam.h"
#include "bench/solids/hex_block.h"

namespace palpate::bench {
namespace {

constexpr double modulus = 10e3;

/// A tube of inner radius a and outer b under inner pressure p, nothing moving along it (Lame 1833):
///   u_r = (1 + nu)/E [(1 - 2 nu) A r + B/r],   A = p a^2/(b^2 - a^2),   B = A b^2
struct Tube {
  static constexpr double a = 0.010, b = 0.020, pressure = 1e-3;
  static double widening(double r, double nu) {
    const double A = pressure * a * a / (b * b - a * a);
    return (1 + nu) / modulus * ((1 - 2 * nu) * A * r + A * b * b / r);
  }
};

using Stiffness = std::function<double(const Vec3&)>;

/// Cubes whose centres lie in the wall: its faces become stairs of this step.
Stiffness whole_cells(double step) {
  return [step](const Vec3& x) {
    const double r =
        std::hypot((std::floor(x.x() / step) + 0.5) * step, (std::floor(x.y() / step) + 0.5) * step);
    return r > Tube::a && r < Tube::b ? 1.0 : 0.0;
  };
}

/// Cubes as stiff as the share of them that lies in the wall.
Stiffness filled_cells(double edge) {
  return [edge](const Vec3& x) {
    constexpr int n = 32;
    int inside = 0;
    for (int i = 0; i < n * n; ++i) {
      const double r =
          std::hypot(x.x() + ((i % n + 0.5) / n - 0.5) * edge, x.y() + ((i / n + 0.5) / n - 0.5) * edge);
      inside += r > Tube::a && r < Tube::b ? 1 : 0;
    }
    return 1.0 * inside / (n * n);
  };
}

/// A quarter of the tube. Pressure acts on the true inner face, and on the corners of whatever cell this runs through.
class QuarterTube {
 public:
  QuarterTube(double edge, double nu, const Stiffness& stiffness)
      : nu_(nu),
        tube_({side(edge), side(edge), 1}, Vec3::Constant(edge), {.modulus = modulus, .poisson_ratio = nu},
              stiffness) {
    std::map<std::array<int, 2>, std::array<int, 2>> at;  // nodes by place
    for (int i = 0; i < tube_.n_nodes(); ++i) {
      const Vec3& x = tube_.rest(i);
      tube_.hold(i, 2);
      for (int axis = 0; axis < 2; ++axis)
        if (x[axis] < 1e-9) tube_.hold(i, axis);
      at[{static_cast<int>(std::lround(x.x() / edge)), static_cast<int>(std::lround(x.y() / edge))}]
        [x.z() > 1e-9 ? 1 : 0] = i;
    }
    std::map<int, Vec3> load;
    constexpr int n = 4000;
    for (int i = 0; i < n; ++i) {
      const double angle = (i + 0.5) / n * std::numbers::pi / 2;
      const Vec3 outward(std::cos(angle), std::sin(angle), 0);
      const Vec3 force = Tube::pressure * Tube::a * std::numbers::pi / 2 / n * edge * outward;
      const Vec3 x = Tube::a * outward / edge;
      // Nearest cell that is there: of a stair it may lie one further out.
      std::array<int, 2> cell{static_cast<int>(x.x()), static_cast<int>(x.y())};
      double best = 1e9;
      for (int a = -3; a <= 3; ++a)
        for (int b = -3; b <= 3; ++b) {
          const std::array<int, 2> c{static_cast<int>(x.x()) + a, static_cast<int>(x.y()) + b};
          const Vec3 centre(edge * (c[0] + 0.5), edge * (c[1] + 0.5), 0.5 * edge);
          if (c[0] < 0 || c[1] < 0 || stiffness(centre) == 0) continue;
          const double away = (x - centre / edge).head<2>().cwiseAbs().maxCoeff();
          if (away < best) best = away, cell = c;
        }
      const double p = std::clamp(x.x() - cell[0], 0.0, 1.0), q = std::clamp(x.y() - cell[1], 0.0, 1.0);
      for (int c = 0; c < 4; ++c)
        for (const int node : at.at({cell[0] + (c & 1), cell[1] + (c >> 1)})) {
          const double weight = ((c & 1) != 0 ? p : 1 - p) * (c >> 1 != 0 ? q : 1 - q);
          load.try_emplace(node, Vec3::Zero()).first->second += 0.5 * weight * force;
        }
    }
    for (const auto& [node, force] : load) tube_.load(node, force);
    EXPECT_TRUE(tube_.solve());
  }

  /// Of what nodes move outwards, in the mean over the middle of the wall, over Lame's.
  double widening() const {
    double sum = 0, count = 0;
    for (int i = 0; i < tube_.n_nodes(); ++i) {
      const Vec3 x(tube_.rest(i).x(), tube_.rest(i).y(), 0);
      if (x.norm() < 0.013 || x.norm() > 0.017) continue;
      sum += tube_.displacement(i).dot(x.normalized()) / Tube::widening(x.norm(), nu_);
      count += 1;
    }
    return sum / count;
  }

 private:
  static int side(double edge) { return static_cast<int>(std::lround(Tube::b / edge)); }
  double nu_;
  HexBlock tube_;
};

TEST(Tube, WidensAsLameSays) {
  for (const double nu : {0.3, 0.45, 0.49}) {
    for (const auto& [cells, within] : std::map<int, double>{{5, 0.02}, {10, 0.005}}) {
      const double edge = Tube::a / cells, filled = QuarterTube(edge, nu, filled_cells(edge)).widening();
      std::printf("nu %.2f, %d filled cells in the wall: %.4f of Lame's\n", nu, cells, filled);
      EXPECT_NEAR(filled, 1, within);
    }
    // Of whole cells the stair errs, not the element: what fine cells find on the same stair is further from the tube.
    const double edge = Tube::a / 10, whole = QuarterTube(edge, nu, whole_cells(edge)).widening(),
                 stair = QuarterTube(edge / 2, nu, whole_cells(edge)).widening();
    std::printf("nu %.2f, 10 whole cells in the wall: %.4f, their stair alone %.4f\n", nu, whole, stair);
    EXPECT_NEAR(whole, 1, 0.04);
    EXPECT_GT(stair, whole + 0.005);
  }
}

/// A square bar of side a whose ends turn against each other by theta and may warp (de Saint-Venant 1855):
///   M = 0.140577 a^4 mu theta / L
/// Of two cells no node is where it could warp, so that nothing but the polar moment is left: a^4/6, 1.19 of it.
TEST(Bar, TwistsAsDeSaintVenantSays) {
  const std::map<int, double> within = {{2, 0.24}, {4, 0.07}, {8, 0.02}};
  for (const double nu : {0.3, 0.45, 0.49})
    for (const auto& [cells, bound] : within) {
      constexpr double a = 0.02, length = 0.02, theta = 1e-4;
      const double edge = a / cells;
      HexBlock bar({cells, cells, cells}, Vec3::Constant(edge), {.modulus = modulus, .poisson_ratio = nu});
      const Vec3 middle(a / 2, a / 2, 0);
      for (int n = 0; n < bar.n_nodes(); ++n) {
        const Vec3 x = bar.rest(n) - middle;
        const bool low = x.z()<1e-9, high = x.z()> length - 1e-9;
        if (!low && !high) continue;
        bar.hold(n, 0, high ? -theta * x.y() : 0), bar.hold(n, 1, high ? theta * x.x() : 0);
        if (low && std::hypot(x.x(), x.y()) < 1e-9) bar.hold(n, 2);
      }
      EXPECT_TRUE(bar.solve());
      double moment = 0;
      for (const int n : bar.nodes([&](const Vec3& x) { return x.z() > length - 1e-9; })) {
        const Vec3 x = bar.rest(n) - middle, f = -bar.force(n);
        moment += x.x() * f.y() - x.y() * f.x();
      }
      const double expected = 0.140577 * std::pow(a, 4) * modulus / (2 * (1 + nu)) * theta / length;
      std::printf("nu %.2f, %d cells thick: %.4f of de Saint-Venant's moment\n", nu, cells,
                  moment / expected);
      EXPECT_NEAR(moment / expected, 1, bound);
    }
}

/// The cantilever of hex_beam.h on cells that are 10 mm long, 5 mm wide and 2.5 mm high, and others.
TEST(Bar, BendsAsWellOnFlatCells) {
  struct Flat {
    std::array<int, 3> cells;
    double within;
  };
  for (const double nu : {0.3, 0.45, 0.49})
    for (const Flat& flat : {Flat{{16, 4, 8}, 0.05}, Flat{{32, 2, 4}, 0.02}, Flat{{64, 4, 2}, 0.05}}) {
      const Vec3 size(HexBeam::length, HexBeam::height, HexBeam::height);
      const Vec3 edge(size.x() / flat.cells[0], size.y() / flat.cells[1], size.z() / flat.cells[2]);
      HexBlock beam(flat.cells, edge, {.modulus = modulus, .poisson_ratio = nu});
      std::vector<double> share(static_cast<std::size_t>(beam.n_nodes()), 1.0);
      for (int n = 0; n < beam.n_nodes(); ++n) {
        double weight = HexBeam::density * HexBeam::gravity * edge.prod();
        for (int axis = 0; axis < 3; ++axis) {
          if (beam.rest(n)[axis] < 1e-9 || beam.rest(n)[axis] > size[axis] - 1e-9) weight /= 2;
          if (beam.rest(n).x() < 1e-9) beam.hold(n, axis);
        }
        beam.load(n, {0, 0, -weight});
      }
      EXPECT_TRUE(beam.solve());
      double sunk = 0;
      const auto end = beam.nodes([&](const Vec3& x) { return x.x() > size.x() - 1e-9; });
      for (const int n : end) sunk -= beam.displacement(n).z() / static_cast<double>(end.size());
      const double ratio = sunk / HexBeam({.cells = 2, .poisson_ratio = nu}).calculix();
      std::printf("nu %.2f, cells %.1f x %.1f x %.1f mm: %.4f of CalculiX\n", nu, 1e3 * edge.x(),
                  1e3 * edge.y(), 1e3 * edge.z(), ratio);
      EXPECT_NEAR(ratio, 1, flat.within);
    }
}

}  // namespace
}  // namespace palpate::bench
