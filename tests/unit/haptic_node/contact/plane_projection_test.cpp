#include "haptic_node/contact/plane_projection.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

namespace palpate::haptic {
namespace {

using Vec3L = Eigen::Matrix<long double, 3, 1>;

/// Another way to the same point: every subset of up to three planes solved by a least-norm system in long double, the
/// nearest feasible one kept. @return false if none is feasible
bool nearest_by_force(const std::vector<HalfSpace>& planes, const Vec3& x, Vec3L& best) {
  const Vec3L xl = x.cast<long double>();
  long double best_distance = INFINITY;
  const unsigned n = static_cast<unsigned>(planes.size());
  for (unsigned mask = 0; mask < (1u << n); ++mask) {
    const int count = __builtin_popcount(mask);
    if (count > 3) continue;
    Eigen::Matrix<long double, Eigen::Dynamic, 3> rows(count, 3);
    Eigen::Matrix<long double, Eigen::Dynamic, 1> depth(count);
    for (unsigned i = 0, r = 0; i < n; ++i) {
      if ((mask >> i & 1u) == 0) continue;
      rows.row(r) = planes[i].normal.cast<long double>().transpose();
      depth(r++) = planes[i].normal.cast<long double>().dot(planes[i].point.cast<long double>() - xl);
    }
    const Vec3L p = count == 0 ? xl : Vec3L(xl + rows.completeOrthogonalDecomposition().solve(depth));
    bool feasible = true;
    for (const auto& plane : planes)
      feasible =
          feasible && plane.normal.cast<long double>().dot(p - plane.point.cast<long double>()) >= -1e-14L;
    if (feasible && (p - xl).norm() < best_distance) {
      best_distance = (p - xl).norm();
      best = p;
    }
  }
  return std::isfinite(best_distance);
}

HalfSpace random_plane(std::mt19937_64& random) {
  std::normal_distribution<double> g;
  return {Vec3(g(random), g(random), g(random)).normalized(), 0.01 * Vec3(g(random), g(random), g(random))};
}

TEST(ProjectOut, AgreesWithBruteForceOnRandomPlanes) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> g;
  int solved = 0, missed = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<HalfSpace> planes(1 + random() % 6);
    for (auto& plane : planes) plane = random_plane(random);
    const Vec3 x = 0.01 * Vec3(g(random), g(random), g(random));
    Vec3L best = Vec3L::Zero();
    if (!nearest_by_force(planes, x, best)) continue;
    const Projection projection = project_out(planes, x);
    if (!projection.feasible) {  // nearly dependent sets
      ++missed;
      continue;
    }
    ++solved;
    ASSERT_LT((projection.point.cast<long double>() - best).norm(), 1e-9L) << "set " << i;
  }
  EXPECT_GT(solved, 15'000);
  EXPECT_LT(missed, 5);
}

TEST(ProjectOut, GivesPushesThatSumToTheWay) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<HalfSpace> planes = {random_plane(random), random_plane(random), random_plane(random)};
    const Vec3 x(0.001, 0.002, -0.001);
    const Projection projection = project_out(planes, x);
    if (!projection.feasible) continue;
    Vec3 way = Vec3::Zero();
    for (std::size_t k = 0; k < planes.size(); ++k) {
      EXPECT_GE(projection.push[k], 0);
      way += projection.push[k] * planes[k].normal;
    }
    EXPECT_LT((x + way - projection.point).norm(), 1e-12);
  }
}

// The case in which equality on both planes, as printed, is not the nearest point.
TEST(ProjectOut, LeavesOutAPlaneThatWouldPull) {
  const double r = std::sqrt(0.5);
  const std::vector<HalfSpace> planes = {{{0, 1, 0}, {0, 0, 0}}, {{r, r, 0}, {0, 0, 0}}};
  const Vec3 x(-0.2, -0.1, 0.3);
  const Projection projection = project_out(planes, x);
  EXPECT_EQ(projection.push[0], 0);
  EXPECT_NEAR((projection.point - x).norm(), 0.2121320343559643, 1e-12);
}

TEST(ProjectOut, StandsParallelAndRepeatedPlanes) {
  const HalfSpace floor{{0, 0, 1}, {0, 0, 0}};
  HalfSpace tilted = floor;
  tilted.normal = Vec3(1e-6, 0, 1).normalized();
  const Projection projection = project_out(std::vector<HalfSpace>{floor, floor, tilted}, {0, 0, -0.01});
  EXPECT_TRUE(projection.feasible);
  EXPECT_NEAR(projection.point.z(), 0, 1e-9);
}

TEST(ProjectOut, SaysWhenNoPointIsAllowed) {
  const std::vector<HalfSpace> planes = {{{0, 0, 1}, {0, 0, 0.01}}, {{0, 0, -1}, {0, 0, -0.01}}};
  const Projection projection = project_out(planes, {0, 0, 0});
  EXPECT_FALSE(projection.feasible);
  EXPECT_EQ(projection.point, Vec3(0, 0, 0));
}

}  // namespace
}  // namespace palpate::haptic
