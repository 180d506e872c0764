#include "bench/haptic/proxy_oracle.h"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace palpate::bench {
namespace {

using haptic::HalfSpace;

/// The point nearest to x that lies on all `Count` planes: p = x + N (N^T N)^-1 d.
template <int Count>
Vec3L on_all(const std::array<Vec3L, 3>& normals, const std::array<long double, 3>& depth, const Vec3L& x) {
  Eigen::Matrix<long double, 3, Count> n;
  Eigen::Matrix<long double, Count, 1> d;
  for (int i = 0; i < Count; ++i) {
    n.col(i) = normals[static_cast<std::size_t>(i)];
    d(i) = depth[static_cast<std::size_t>(i)];
  }
  if constexpr (Count == 3) return x + n.transpose().fullPivLu().solve(d);
  const Eigen::Matrix<long double, Count, Count> gram = n.transpose() * n;
  return x + n * gram.fullPivLu().solve(d);
}

Vec3L solve(int n, const std::array<Vec3L, 3>& normals, const std::array<long double, 3>& depth,
            const Vec3L& x) {
  if (n == 1) return on_all<1>(normals, depth, x);
  if (n == 2) return on_all<2>(normals, depth, x);
  if (n == 3) return on_all<3>(normals, depth, x);
  return x;
}

bool conditions_hold(std::span<const HalfSpace> planes, const Vec3& x, const haptic::Projection& p) {
  Vec3 sum = x;
  int active = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!(p.push[i] >= 0)) return false;
    active += p.push[i] > 0;
    sum += p.push[i] * planes[i].normal;
    if (!(planes[i].normal.dot(p.point - planes[i].point) >= -1e-9)) return false;
  }
  return active <= 3 && (sum - p.point).norm() <= 1e-9;
}

}  // namespace

bool nearest_by_enumeration(std::span<const HalfSpace> planes, const Vec3& x, Vec3L& nearest) {
  const Vec3L xl = x.cast<long double>();
  long double best = std::numeric_limits<long double>::infinity();
  for (unsigned mask = 0; mask < (1u << planes.size()); ++mask) {
    const int n = std::popcount(mask);
    if (n > 3) continue;
    std::array<Vec3L, 3> normals;
    std::array<long double, 3> depth{};
    for (std::size_t i = 0, row = 0; i < planes.size(); ++i) {
      if ((mask >> i & 1u) == 0) continue;
      normals[row] = planes[i].normal.cast<long double>();
      depth[row] = normals[row].dot(planes[i].point.cast<long double>() - xl);
      ++row;
    }
    const Vec3L p = solve(n, normals, depth, xl);
    const long double distance = (p - xl).norm();
    if (!(distance < best)) continue;
    const bool feasible = std::all_of(planes.begin(), planes.end(), [&](const HalfSpace& plane) {
      return plane.normal.cast<long double>().dot(p - plane.point.cast<long double>()) >= -1e-14L;
    });
    if (!feasible) continue;
    best = distance;
    nearest = p;
  }
  return std::isfinite(best);
}

ProxyErrors compare_with_oracle(std::size_t sets, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> g;
  const auto vector = [&] { return Vec3(g(random), g(random), g(random)); };
  ProxyErrors errors;
  std::vector<HalfSpace> planes;
  for (; errors.sets < sets; ++errors.sets) {
    planes.resize(1 + random() % haptic::max_planes);
    for (HalfSpace& plane : planes) plane = {vector().normalized(), 0.01 * vector()};
    const Vec3 x = 0.01 * vector();
    Vec3L exact;
    const bool feasible = nearest_by_enumeration(planes, x, exact);
    const haptic::Projection found = haptic::project_out(planes, x);
    errors.infeasible += !feasible;
    if (feasible != found.feasible) {
      ++errors.missed;
      continue;
    }
    if (!feasible) continue;
    errors.distance = std::max(errors.distance, (found.point.cast<long double>() - exact).norm());
    errors.conditions_broken += !conditions_hold(planes, x, found);
  }
  return errors;
}

}  // namespace palpate::bench
