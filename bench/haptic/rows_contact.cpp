#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/haptic/rows.h"
#include "bench/haptic/shapes.h"

namespace palpate::bench {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Slide {
  double step_beyond = -1;       // beyond K v T [N]
  double depth = 0;              // of hand + F / K below the surface [m]
  double turned = 0;             // of the force from `ideal`, while it is above 0.1 N [rad]
  double least = 1e9, most = 0;  // force, once settled [N]
  double end = 0;                // force at the end [N]
  std::uint64_t outran = 0;
};

/// A kinematic hand follows `path` over `shape` until `until`. From `settled` on it is looked at.
Slide slide(const Shape& shape, const Path& path, double rate_Hz, double delay, double settled, double until,
            const std::function<Vec3(const Vec3& x)>& ideal = {}) {
  Case c;
  c.device = device_models[3];
  c.object = object_models[0];
  c.rate_Hz = rate_Hz;
  c.link.delay = delay;
  Trial trial(c, path);
  trial.kinematic = true;
  trial.alter_patch = [&](ContactPatch& patch, const Vec3& known_proxy) {
    patch = nearest_patch(shape, known_proxy, patch.tick);
  };
  Slide result;
  trial.run(until, [&] {
    const Vec3 f = trial.rendered().force, x = trial.plant().x();
    result.end = f.norm();
    if (trial.t() < settled) return;
    result.least = std::min(result.least, f.norm());
    result.most = std::max(result.most, f.norm());
    // The hand has moved on for a tick since the force was computed.
    const Vec3 then = x - trial.plant().v() * 1e-3;
    result.depth = std::max(result.depth, depth_below(shape, then + f / c.stiffness));
    if (ideal && f.norm() > 0.1) {
      const Vec3 n = ideal(then);
      result.turned = std::max(result.turned, std::atan2(n.cross(f).norm(), n.dot(f)));
    }
  });
  result.step_beyond = trial.force_step_beyond_motion();
  result.outran = trial.controller().outran();
  return result;
}

/// Along the points one after another: straight, each leg in its seconds.
Path legs(std::vector<std::pair<double, Vec3>> points) {
  return [points = std::move(points)](double t) {
    Aim aim;
    aim.q = points.back().second;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const auto& [t0, p0] = points[i];
      const auto& [t1, p1] = points[i + 1];
      if (t >= t1) continue;
      aim.q_dot = (p1 - p0) / (t1 - t0);
      aim.q = p0 + aim.q_dot * (t - t0);
      break;
    }
    return aim;
  };
}

/// From 5 mm above the pole down to `depth`, then round a great circle that crosses the facets at all angles.
Path round_sphere(double radius, double depth, double speed) {
  return [=](double t) {
    const Vec3 from = Vec3(0.6, 0.3, 0.74).normalized(), to = from.cross(Vec3(0.2, 1, 0.1)).normalized();
    const double r = radius + 5e-3 - (5e-3 + depth) * std::min(t / 0.3, 1.0);
    const double omega = speed / (radius - depth);
    const double a = omega * std::max(t - 0.5, 0.0);
    Aim aim;
    aim.q = r * (std::cos(a) * from + std::sin(a) * to);
    if (t < 0.3) aim.q_dot = -(5e-3 + depth) / 0.3 * from;
    if (t >= 0.5) aim.q_dot = r * omega * (-std::sin(a) * from + std::cos(a) * to);
    return aim;
  };
}

}  // namespace

Row edges_and_corners() {
  constexpr double d = 1e-3;
  double step = -1, depth = 0, beside = 0, after = 0;
  std::string wrong;
  for (const auto& [rate, delay] : {std::pair{20.0, 50e-3}, std::pair{150.0, 5e-3}, std::pair{1000.0, 0.0}}) {
    for (const double angle : {60.0, 90.0, 120.0, 150.0}) {
      const Shape edge = convex_edge(angle * degree);
      // Over the edge at 0.1 m/s, and along it 0.5 mm beyond the other face.
      const Slide over = slide(
          edge,
          legs({{0, {-0.015, 0, 0.005}}, {0.3, {-0.015, 0, -d}}, {0.6, {0.015, 0, -d}}, {1, {0.015, 0, -d}}}),
          rate, delay, 0.35, 1.0);
      const Vec3 outside = 5e-4 * Vec3(std::sin(angle * degree), 0, -std::cos(angle * degree)) +
                           2e-3 * Vec3(-std::cos(angle * degree), 0, -std::sin(angle * degree));
      const Slide along = slide(edge,
                                legs({{0, outside + Vec3(0, -0.01, 0)},
                                      {0.2, outside + Vec3(0, 0.01, 0)},
                                      {0.4, outside + Vec3(0, -0.01, 0)}}),
                                rate, delay, 0, 0.4);
      step = std::max(step, over.step_beyond);
      depth = std::max(depth, over.depth);
      beside = std::max(beside, along.most);
      if (angle <= 90) after = std::max(after, over.end);
    }
    const Slide corner = slide(
        concave_corner(),
        legs({{0, {0.005, 0.01, 0.01}}, {0.3, {-d, 0.01, 0.01}}, {0.6, {-d, -d, -d}}, {1.5, {-d, -d, -d}}}),
        rate, delay, 0.35, 1.5);
    const double expected = 500 * d * std::sqrt(3.0);
    if (std::abs(corner.end / expected - 1) > 0.02)
      wrong += fmt::format("; corner {:.3f} N, not {:.3f}", corner.end, expected);
    const Slide twice =
        slide(repeated_plane(1e-6), legs({{0, {0, 0, 0.005}}, {0.3, {0, 0, -d}}, {0.6, {0.03, 0, -d}}}), rate,
              delay, 0.35, 0.6);
    if (std::abs(twice.end / (500 * d) - 1) > 0.02)
      wrong += fmt::format("; repeated plane {:.3f} N", twice.end);
    step = std::max({step, corner.step_beyond, twice.step_beyond});
    depth = std::max({depth, corner.depth, twice.depth});
  }
  return {
      "S8", "edges of 60, 90, 120, 150 deg, a concave corner, repeated and near-parallel planes, at 0.1 m/s",
      "steps <= K v T + 0.1 N, <= (F + B v) / K + 0.1 mm deep, 0 N beside an edge and beyond it, corner and "
      "planes true",
      fmt::format("beyond K v T {:.3f} N; {:.3f} mm deeper; beside {:g} N, beyond {:g} N{}", step,
                  1e3 * depth, beside, after, wrong),
      step <= 0.1 && depth <= 3e-4 && beside == 0 && after == 0 && wrong.empty()};
}

Row sphere_is_round() {
  constexpr double radius = 0.03, d = 1e-3;
  double step = -1, depth = 0, turned = -1, fall = 1e9;
  std::uint64_t outran = 0, flagged = 0;
  for (const double facet : {5.0, 10.0}) {
    const Shape ball = sphere(radius, facet * degree);
    const double limit = roughness(ball, Vec3::Zero()) / degree + 1;
    const auto radial = [](const Vec3& x) { return Vec3(x.normalized()); };
    const std::pair<double, double> links[] = {{150, 5e-3}, {1000, 0}};
    for (const auto& [rate, delay] : links) {
      const Slide s = slide(ball, round_sphere(radius, d, 0.1), rate, delay, 0.5, 1.5, radial);
      step = std::max(step, s.step_beyond);
      depth = std::max(depth, s.depth);
      turned = std::max(turned, s.turned / degree - limit);
      fall = std::min(fall, s.least);
      outran += s.outran;
    }
    const Slide slow = slide(ball, round_sphere(radius, d, 0.01), 20, 50e-3, 0.5, 2.0, radial);
    step = std::max(step, slow.step_beyond);
    depth = std::max(depth, slow.depth);
    turned = std::max(turned, slow.turned / degree - limit);
    fall = std::min(fall, slow.least);
    outran += slow.outran;
    for (const double speed : {0.1, 0.4}) {  // a patch of 16 facets does not reach so far
      const Slide fast = slide(ball, round_sphere(radius, d, speed), 20, 50e-3, 0.5, 0.8, radial);
      step = std::max(step, fast.step_beyond);
      flagged += fast.outran > 0;
    }
  }
  return {"S8",
          "sphere of 30 mm in facets of 5 and 10 deg: 0.1 m/s at 150 and 1000 Hz, 0.01 m/s at 20 Hz, 50 ms",
          "steps as above, <= 0.1 mm deeper, direction within that of the facets + 1 deg, no fall-through; "
          "flagged at 0.1 and 0.4 m/s with 20 Hz, 50 ms",
          fmt::format("beyond K v T {:.3f} N; {:.3f} mm deeper; {:+.2f} deg of the limit; least {:.2f} N; "
                      "outran {}, {} of 4 "
                      "flagged",
                      step, 1e3 * depth, turned, fall, outran, flagged),
          step <= 0.1 && depth <= 1e-4 && turned <= 0 && fall > 0.1 && outran == 0 && flagged == 4};
}

}  // namespace palpate::bench
