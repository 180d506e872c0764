#include "physics_node/collision/point_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::physics {
namespace {

using Vec3 = Eigen::Vector3d;

Vec3 barycentric_of_closest(const Vec3& p, const Triangle& t) noexcept {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - t[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const Vec3 cp = p - t[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0 && (d4 - d3) + (d5 - d6) > 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  if (!(sum > 0)) return {1, 0, 0};  // no area, and no edge claimed it: rounding
  return {va / sum, vb / sum, vc / sum};
}

Triangle at_time(const Triangle& t, const Triangle& dt, double s) noexcept {
  return {t[0] + s * dt[0], t[1] + s * dt[1], t[2] + s * dt[2]};
}

/// Times in [0, 1] at which the four points are in a plane: roots of the cubic (p - a) . ((b - a) x (c - a)), by its
/// turning points and bisection.
struct Roots {
  std::array<double, 3> at{};
  int n = 0;
};
Roots coplanar_times(const Vec3& p, const Vec3& dp, const Triangle& t, const Triangle& dt) noexcept {
  const Vec3 a0 = p - t[0], a1 = dp - dt[0];
  const Vec3 b0 = t[1] - t[0], b1 = dt[1] - dt[0];
  const Vec3 c0 = t[2] - t[0], c1 = dt[2] - dt[0];
  const Vec3 n0 = b0.cross(c0), n1 = b0.cross(c1) + b1.cross(c0), n2 = b1.cross(c1);
  const double k0 = a0.dot(n0), k1 = a0.dot(n1) + a1.dot(n0), k2 = a0.dot(n2) + a1.dot(n1), k3 = a1.dot(n2);
  const auto f = [&](double s) { return k0 + s * (k1 + s * (k2 + s * k3)); };
  // Between turning points f is monotone.
  std::array<double, 4> cut{0, 1, 1, 1};
  int n_cuts = 1;
  const double disc = k2 * k2 - 3 * k3 * k1;
  if (disc > 0) {
    const double root = std::sqrt(disc);
    const double q = -(k2 + std::copysign(root, k2));
    std::array<double, 2> turn{k3 != 0 ? q / (3 * k3) : 2.0, q != 0 ? k1 / q : 2.0};
    if (turn[0] > turn[1]) std::swap(turn[0], turn[1]);
    for (const double s : turn)
      if (s > 0 && s < 1) cut[static_cast<std::size_t>(n_cuts++)] = s;
  }
  cut[static_cast<std::size_t>(n_cuts)] = 1;
  Roots roots;
  for (int i = 0; i < n_cuts; ++i) {
    double lo = cut[static_cast<std::size_t>(i)], hi = cut[static_cast<std::size_t>(i) + 1];
    const bool below = f(lo) < 0;
    if (below == (f(hi) < 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double mid = 0.5 * (lo + hi);
      ((f(mid) < 0) == below ? lo : hi) = mid;
    }
    roots.at[static_cast<std::size_t>(roots.n++)] = 0.5 * (lo + hi);
  }
  return roots;
}

// Why: what moves a thousand times its distance within a step takes some ten; what has been thrown off at any
// speed must not hold up the step.
constexpr int most_advances = 200;

}  // namespace

ClosestPoint closest_point(const Vec3& p, const Triangle& t) noexcept {
  ClosestPoint found;
  found.weight = barycentric_of_closest(p, t);
  found.away = p - (found.weight[0] * t[0] + found.weight[1] * t[1] + found.weight[2] * t[2]);
  found.distance = found.away.norm();
  return found;
}

bool comes_nearer(const Vec3& p, const Vec3& dp, const Triangle& t, const Triangle& dt, const Vec3& away,
                  double least) noexcept {
  Vec3 n = away.normalized();
  const double near_enough = least + 0.1 * (away.norm() - least);
  double s = 0;
  for (int advances = 0; advances < most_advances; ++advances) {
    // No point of the triangle is nearer than its corners are along n, and these close in steadily.
    double until = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 pace = dp - dt[i];
      const double closing = -pace.dot(n);
      if (closing > 0) until = std::min(until, ((p - t[i] + s * pace).dot(n) - least) / closing);
    }
    if (s + until >= 1) return false;
    s += 0.9 * until;
    const ClosestPoint now = closest_point(p + s * dp, at_time(t, dt, s));
    if (!(now.distance >= near_enough)) return true;
    n = now.away / now.distance;
  }
  return true;
}

bool passes_through(const Vec3& p, const Vec3& dp, const Triangle& t, const Triangle& dt) noexcept {
  const Roots roots = coplanar_times(p, dp, t, dt);
  for (int i = 0; i < roots.n; ++i) {
    const double s = roots.at[static_cast<std::size_t>(i)];
    const Triangle now = at_time(t, dt, s);
    const Vec3 q = p + s * dp;
    const Vec3 normal = (now[1] - now[0]).cross(now[2] - now[0]);
    const double area2 = normal.squaredNorm();
    if (!(area2 > 0)) continue;
    const double w1 = (q - now[0]).cross(now[2] - now[0]).dot(normal) / area2;
    const double w2 = (now[1] - now[0]).cross(q - now[0]).dot(normal) / area2;
    if (w1 >= 0 && w2 >= 0 && w1 + w2 <= 1) return true;
  }
  return false;
}

}  // namespace palpate::physics
