// Hexahedra against CalculiX, which is run here: deck, solution and all.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "bench/problems/hex_beam.h"
#include "bench/solids/calculix.h"
#include "bench/solids/hex_block.h"

namespace palpate::bench {
namespace {

class CalculiX : public testing::Test {
 protected:
  void SetUp() override {
    if (calculix().empty()) GTEST_SKIP() << "no CalculiX here: the package calculix-ccx";
  }
};

TEST_F(CalculiX, BendsACantileverAsHexahedraDo) {
  BrickBlock bricks{.bricks = {32, 4, 4},
                    .place =
                        [](const Vec3& s) {
                          return Vec3(HexBeam::length * s.x(), HexBeam::height * (s.y() - 0.5),
                                      HexBeam::height * (s.z() - 0.5));
                        },
                    .modulus = HexBeam::modulus,
                    .density = HexBeam::density,
                    .gravity = HexBeam::gravity};
  const std::map<int, double> within = {{2, 0.05}, {4, 0.02}, {8, 0.005}};
  for (const double nu : {0.3, 0.45, 0.49}) {
    bricks.poisson_ratio = nu;
    const double sunk = -solve(bricks).mean().z();
    for (const auto& [cells, bound] : within) {
      const HexBeam beam({.cells = cells, .poisson_ratio = nu});
      std::printf("nu %.2f, %d cells: %.4f of CalculiX\n", nu, cells, beam.tip() / sunk);
      EXPECT_NEAR(beam.tip() / sunk, 1, bound) << "nu " << nu << ", " << cells << " cells";
      EXPECT_NEAR(beam.calculix() / sunk, 1, 1e-4) << "what is kept for where it is not installed";
    }
  }
}

/// Cook's membrane: a plate from 44 mm high to 16 mm over 48 mm, held at its left, lifted at its right, in plane strain.
struct Cook {
  static constexpr double length = 0.048, thickness = 0.001, modulus = 10e3, lift = 1e-6;
  static double lower(double x) { return 44.0 / 48 * x; }
  static double upper(double x) { return 0.044 + 16.0 / 48 * x; }
};

/// Mean rise of the right end, on square cells of this stiffness around their centres.
double rise(int cells, double nu, const std::function<double(const Vec3&)>& stiffness) {
  const double edge = Cook::length / cells;
  HexBlock plate({cells, 1, static_cast<int>(std::lround(0.060 / edge))}, {edge, Cook::thickness, edge},
                 {.modulus = Cook::modulus, .poisson_ratio = nu}, stiffness);
  const auto end = plate.nodes([](const Vec3& x) { return x.x() > Cook::length - 1e-9; });
  double low = 1, high = 0;
  for (const int n : end) low = std::min(low, plate.rest(n).z()), high = std::max(high, plate.rest(n).z());
  for (int n = 0; n < plate.n_nodes(); ++n) {
    plate.hold(n, 1);
    if (plate.rest(n).x() < 1e-9) plate.hold(n, 0), plate.hold(n, 2);
  }
  for (const int n : end) {
    const bool at_edge = plate.rest(n).z() < low + 1e-9 || plate.rest(n).z() > high - 1e-9;
    plate.load(n, {0, 0, Cook::lift * edge / (high - low) * (at_edge ? 0.25 : 0.5)});
  }
  EXPECT_TRUE(plate.solve());
  double mean = 0;
  for (const int n : end) mean += plate.displacement(n).z() / static_cast<double>(end.size());
  return mean;
}

/// Cells whose centres lie in the plate; its slopes become a stair of `stairs` steps.
std::function<double(const Vec3&)> whole_cells(int stairs) {
  const double step = Cook::length / stairs;
  return [step](const Vec3& x) {
    const double column = (std::floor(x.x() / step) + 0.5) * step,
                 row = (std::floor(x.z() / step) + 0.5) * step;
    return row > Cook::lower(column) && row < Cook::upper(column) ? 1.0 : 0.0;
  };
}

/// Cells as stiff as the share of them that lies in the plate.
std::function<double(const Vec3&)> filled_cells(int cells) {
  const double edge = Cook::length / cells;
  return [edge](const Vec3& x) {
    constexpr int n = 64;  // columns of the cell
    double share = 0;
    for (int i = 0; i < n; ++i) {
      const double column = x.x() + ((i + 0.5) / n - 0.5) * edge;
      const double low = std::max(Cook::lower(column), x.z() - edge / 2),
                   high = std::min(Cook::upper(column), x.z() + edge / 2);
      share += std::max(0.0, high - low) / edge / n;
    }
    return share;
  };
}

TEST_F(CalculiX, LiftsCooksMembraneAsHexahedraDo) {
  for (const double nu : {0.3, 0.45, 0.49}) {
    const double truth = solve({.bricks = {24, 1, 24},
                                .place =
                                    [](const Vec3& s) {
                                      const double x = Cook::length * s.x();
                                      return Vec3(x, Cook::thickness * s.y(),
                                                  Cook::lower(x) + s.z() * (Cook::upper(x) - Cook::lower(x)));
                                    },
                                .modulus = Cook::modulus,
                                .poisson_ratio = nu,
                                .lift = Cook::lift,
                                .flat = true})
                             .mean()
                             .z();
    struct Bound {
      int cells;
      double filled, whole;
    };
    for (const Bound& within : {Bound{12, 0.06, 0.18}, Bound{24, 0.02, 0.08}, Bound{48, 0.005, 0.04}}) {
      const double whole = rise(within.cells, nu, whole_cells(within.cells)) / truth,
                   filled = rise(within.cells, nu, filled_cells(within.cells)) / truth;
      std::printf("nu %.2f, %d cells long: whole %.4f of CalculiX, filled %.4f\n", nu, within.cells, whole,
                  filled);
      EXPECT_NEAR(filled, 1, within.filled);
      EXPECT_NEAR(whole, 1, within.whole);
    }
    if (nu != 0.45) continue;
    // What the stair does alone: the same shape in cells of an eighth. Its inner corners carry nothing.
    const double stair = rise(96, nu, whole_cells(12)) / truth;
    std::printf("nu %.2f, a stair of 12 steps: %.4f\n", nu, stair);
    EXPECT_GT(stair, 1.3);
  }
}

}  // namespace
}  // namespace palpate::bench
