// What a V-cycle solves: the same system as the element's own matrices, in as few cycles as promised, whatever the size, the shape, the
// contrast and what is held; symmetric; and with the same bits on any number of threads.

#include "physics_node/step/multigrid/hierarchy.h"

#include <gtest/gtest.h>

#include <random>

#include "physics_node/step/multigrid/conjugate_gradients.h"
#include "tests/support/physics/solid_bodies.h"

namespace palpate::physics {
namespace {

using test::solid_block;
using test::SolidBlock;

std::size_t at(Index n) { return static_cast<std::size_t>(n); }

template <class Real>
struct Solver {
  explicit Solver(const Body& of, double dt = 0.02) : body(of), hierarchy(body), gradients(hierarchy) {
    hierarchy.set_step(dt);
    hierarchy.linearise({}, 1);
  }
  template <class Visit>
  void for_free(const Visit& visit) {
    for (Index n = 0; n < hierarchy.fine().n_nodes(); ++n) {
      const Index node = hierarchy.storage()[at(n)];
      if (node >= 0 && body.inverse_mass[at(node)] > 0) visit(n, body.rest_position(node));
    }
  }
  /// A force on the nine nodes that lie farthest along a direction.
  void push(const Vec3& along) {
    std::vector<std::pair<double, Index>> far;
    for_free([&](Index n, const Vec3& x) { far.emplace_back(-x.dot(along), n); });
    std::sort(far.begin(), far.end());
    for (std::size_t n = 0; n < 9; ++n) {
      gradients.b[2][at(far[n].second)] = Real(-0.01);
      gradients.b[0][at(far[n].second)] = Real(0.004);
    }
  }
  int cycles(double tolerance, const Crew& crew = {}) {
    const GradientReport report = gradients.solve(hierarchy, crew, tolerance, 60);
    return report.converged ? report.cycles : 1000;
  }

  Body body;
  Hierarchy<Real> hierarchy;
  ConjugateGradients<Real> gradients;
};

int cycles(const Body& body, const Vec3& along = Vec3::UnitZ(), double tolerance = 1e-2, double dt = 0.02) {
  Solver<float> solver(body, dt);
  solver.push(along);
  return solver.cycles(tolerance);
}

TEST(Hierarchy, SolvesTheSystemOfTheElements) {
  Solver<double> s(
      solid_block({.cells = 7},
                  [](int i, int j, int k) { return i == 3 && k > 2 ? 0.0 : 1.0 + (j > 4 ? 9 : 0); }),
      0.01);
  std::mt19937_64 dice(1);
  s.for_free([&](Index n, const Vec3&) {
    for (auto& axis : s.gradients.b) axis[at(n)] = std::uniform_real_distribution<double>(-1, 1)(dice);
  });
  EXPECT_LT(s.cycles(1e-10), 60);
  // r = b - (M / dt^2 + K) x, with the matrix of a cell from differences of its forces.
  const BodyGrid grid = body_grid(s.body);
  const HexMatrix unit = hex_stiffness({.modulus = 100e3, .poisson_ratio = 0.45}, s.body.lattice.step);
  std::vector<Vec3> r(at(grid.level.n_nodes), Vec3::Zero());
  const auto vector = [](const Three<double>& of, Index n) {
    return Vec3(of[0][at(n)], of[1][at(n)], of[2][at(n)]);
  };
  for (const GridCell& cell : grid.level.cells) {
    Eigen::Matrix<double, 24, 1> x;
    for (int a = 0; a < 8; ++a) x.segment<3>(3 * a) = vector(s.gradients.x, cell.corner[at(a)]);
    const Eigen::Matrix<double, 24, 1> f = cell.stiffness * (unit * x);
    for (int a = 0; a < 8; ++a) r[at(cell.corner[at(a)])] -= f.segment<3>(3 * a);
  }
  double left = 0, all = 0;
  s.for_free([&](Index n, const Vec3&) {
    const double mass = s.body.solid->mass[at(grid.storage[at(n)])];
    left += (r[at(n)] + vector(s.gradients.b, n) - mass / 1e-4 * vector(s.gradients.x, n)).squaredNorm();
    all += vector(s.gradients.b, n).squaredNorm();
  });
  EXPECT_LT(std::sqrt(left / all), 1e-7);  // the matrix has seven digits
}

TEST(Hierarchy, IsSymmetricAndPositive) {
  Solver<double> s(solid_block({.cells = 13, .held = "fixed = [\"-z\", \"+z\"]"}));
  std::mt19937_64 dice(2);
  const auto any = [&](Three<double>& to) {
    s.for_free([&](Index n, const Vec3&) {
      for (auto& axis : to) axis[at(n)] = std::uniform_real_distribution<double>(-1, 1)(dice);
    });
  };
  Three<double> p, q, vp, vq;
  for (auto* three : {&p, &q, &vp, &vq})
    for (auto& axis : *three) axis = ZeroedArray<double>(at(s.hierarchy.fine().n_nodes()));
  any(p), any(q);
  const auto apply = [&](const Three<double>& from, Three<double>& to) {
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t n = 0; n < from[a].size(); ++n) s.hierarchy.fine().r[a][n] = from[a][n];
    s.hierarchy.v_cycle({});
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t n = 0; n < from[a].size(); ++n) to[a][n] = s.hierarchy.fine().x[a][n];
  };
  apply(p, vp), apply(q, vq);
  const auto dot = [&](const Three<double>& a, const Three<double>& b) {
    return s.gradients.dot(s.hierarchy, {}, a, b);
  };
  EXPECT_NEAR(dot(p, vq), dot(q, vp), 1e-10 * std::sqrt(dot(p, vp) * dot(q, vq)));
  EXPECT_GT(dot(p, vp), 0);
}

TEST(Hierarchy, NeedsAsManyCyclesHoweverFineTheCells) {
  const int coarse = cycles(solid_block({.cells = 16})), fine = cycles(solid_block({.cells = 32}));
  EXPECT_LE(coarse, 5);
  EXPECT_LE(fine, 5);
  EXPECT_LE(std::abs(coarse - fine), 1);
  EXPECT_LE(cycles(solid_block({.cells = 16}), Vec3::UnitZ(), 1e-4), 8);
  EXPECT_LE(cycles(solid_block({.cells = 16}), Vec3::UnitZ(), 1e-2, 0), 5);  // statics
  EXPECT_LE(cycles(solid_block({.cells = 16, .hourglass = "isotropic"})), 7);
}

TEST(Hierarchy, BearsNearlyIncompressibleTissueAndAStiffLump) {
  EXPECT_LE(cycles(solid_block({.cells = 16, .poisson_ratio = 0.49})), 10);
  EXPECT_LE(cycles(solid_block({.cells = 16},
                               [](int i, int j, int k) {
                                 return (Vec3(i, j, k) - Vec3::Constant(7.5)).norm() < 3.5 ? 100.0 : 1.0;
                               })),
            10);
}

TEST(Hierarchy, BearsAnIrregularShapeAndASlit) {
  const auto blob = [](int i, int j, int k) { return test::in_blob(Vec3(i + 0.5, j + 0.5, k + 0.5) / 24); };
  EXPECT_LE(cycles(solid_block({.cells = 24}, blob)), 10);
  for (const int slit : {7, 8})
    EXPECT_LE(cycles(solid_block({.cells = 16},
                                 [slit](int i, int, int k) { return i == slit && k >= 4 ? 0.0 : 1.0; })),
              10)
        << slit;
}

// Both ends are held, and an odd length keeps one of them off the coarse lattice.
TEST(Hierarchy, BearsHeldNodesOffTheCoarseLattice) {
  const auto tube = [](int i, int j, int k) {
    const double r = std::hypot(i - 9.5, j - 9.5);
    return r < 10 && r > 6 && k < 19 ? 1.0 : 0.0;
  };
  SolidBlock block{.cells = 20,
                   .held = "fixed = [\"-z\", { min_mm = [-30, -30, 22.4], max_mm = [30, 30, 30] }]"};
  EXPECT_LE(cycles(solid_block(block, tube), Vec3(1, 0, 0)), 10);
}

TEST(Hierarchy, TurnsWithTheBody) {
  Solver<float> s(solid_block({.cells = 16}));
  s.for_free([&](Index n, const Vec3& x) {
    const double turn = 0.5 * M_PI * (x.z() + 0.02) / 0.04;
    s.hierarchy.fine().u[0][at(n)] =
        static_cast<float>(std::cos(turn) * x.x() - std::sin(turn) * x.y() - x.x());
    s.hierarchy.fine().u[1][at(n)] =
        static_cast<float>(std::sin(turn) * x.x() + std::cos(turn) * x.y() - x.y());
  });
  s.hierarchy.linearise({}, 1);
  s.push(Vec3::UnitZ());
  EXPECT_LE(s.cycles(1e-2), 10);
}

// Runs, what is left over of them, and cells with nodes in common among those: AVX2 and AVX-512 to the bit, SSE2 to rounding.
TEST(Hierarchy, HasTheSameBitsInVectorsOfAnyWidth) {
  Solver<float> s(solid_block(
      {.cells = 19}, [](int i, int j, int k) { return (7 * i + 3 * j + k) % 11 == 0 ? 0.0 : 1.0 + j; }));
  std::mt19937_64 dice(3);
  s.for_free([&](Index n, const Vec3&) {
    for (auto* three : {&s.hierarchy.fine().d, &s.hierarchy.fine().u})
      for (auto& axis : *three) axis[at(n)] = std::uniform_real_distribution<float>(-1e-4F, 1e-4F)(dice);
  });
  const LevelContext<float> m = s.hierarchy.fine().context();
  const auto gathered = [&](const LevelKernel<float>& kernel) {
    std::vector<float> all;
    for (Index l = 0; l < m.n_layers; ++l) kernel.linearise(m, l);
    for (Index l = 0; l < m.n_layers; ++l) kernel.product(m, m.d, l);
    for (float* const* from : {m.low.data(), m.high.data()})
      for (int a = 0; a < 3; ++a)
        for (Index n = 0; n < s.hierarchy.fine().n_nodes(); ++n) {
          all.push_back(from[a][n]);
          from[a][n] = 0;
        }
    for (auto* entry : m.inverse)
      for (Index n = 0; n < s.hierarchy.fine().n_nodes(); ++n) {
        all.push_back(entry[n]);
        entry[n] = 0;
      }
    for (auto* entry : m.block_high) std::fill_n(entry, s.hierarchy.fine().n_nodes(), 0.0F);
    return all;
  };
  gathered(sse2::level_kernel<float>(true));
  const std::vector<float> narrow = gathered(sse2::level_kernel<float>(true));
  float largest = 0;
  for (const float value : narrow) largest = std::max(largest, std::abs(value));
  if (__builtin_cpu_supports("avx2") == 0) return;
  const std::vector<float> middle = gathered(avx2::level_kernel<float>(true));
  for (std::size_t n = 0; n < narrow.size(); ++n) ASSERT_NEAR(middle[n], narrow[n], 1e-5F * largest);
  if (__builtin_cpu_supports("avx512f") == 0) return;
  EXPECT_TRUE(gathered(avx512::level_kernel<float>(true)) == middle);
}

TEST(Hierarchy, HasTheSameBitsOnAnyNumberOfThreads) {
  std::vector<float> first;
  for (const int threads : {1, 2, 3, 8}) {
    Solver<float> s(
        solid_block({.cells = 20}, [](int i, int j, int) { return i == 9 && j > 5 ? 0.0 : 1.0; }));
    s.push(Vec3::UnitZ());
    Team team(threads);
    s.cycles(1e-5, {&team, threads});
    std::vector<float> x;
    for (const auto& axis : s.gradients.x) x.insert(x.end(), axis.data(), axis.data() + axis.size());
    if (first.empty()) first = x;
    EXPECT_TRUE(x == first) << threads;
  }
}

}  // namespace
}  // namespace palpate::physics
