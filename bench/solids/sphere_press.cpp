#include "bench/solids/sphere_press.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/problems/held_block.h"
#include "bench/problems/stopwatch.h"
#include "bench/solids/driven_body.h"
#include "physics_node/boundary/boundary.h"

namespace palpate::bench {
namespace {

using physics::Index;

physics::Body quarter_block(const SpherePress& how) {
  return held_block({.size = Vec3(SpherePress::breadth / 2, SpherePress::breadth / 2, SpherePress::height),
                     .at = Vec3(SpherePress::breadth / 4, SpherePress::breadth / 4, -SpherePress::height / 2),
                     .edge = how.edge,
                     .modulus = SpherePress::modulus,
                     .density = SpherePress::density,
                     .poisson_ratio = how.poisson_ratio,
                     .model = how.model,
                     .hourglass = how.hourglass});
}

/// The faces of the upper side that the sphere may meet, and what it did in the last step.
class Sphere {
 public:
  Sphere(physics::BodyModel& model, double radius, double edge)
      : model_(model),
        radius_(radius),
        area_(edge * edge),
        k_(40 * SpherePress::modulus / edge * area_ / 16) {
    const physics::Boundary boundary(model, 10 * edge);
    for (std::uint32_t f = 0; f < boundary.surface().facets.size(); ++f) {
      const Vec3 middle = boundary.settled_centroid(f);
      if (middle.z() < -1e-6 || std::hypot(middle.x(), middle.y()) > 3 * radius + 2 * edge) continue;
      auto& face = faces_.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) face[c] = boundary.mass(f, c);
    }
  }

  double depth = 0;  // [m]
  double force = 0;  // of the quarter, in the last step [N]

  void meet(double dt) {
    double up = 0;
    const Vec3 centre(0, 0, radius_ - depth);
    for (const auto& face : faces_) {
      std::array<Vec3, 4> x;
      double lowest = 1;
      for (std::size_t c = 0; c < 4; ++c) {
        x[c] = model_.position(face[c]);
        lowest = std::min(lowest, (x[c] - centre).norm());
      }
      if (lowest > radius_ + 0.01) continue;
      std::array<Vec3, 4> push{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
      for (int s = 0; s < 16; ++s) {
        const double p = (s % 4 + 0.5) / 4, q = (s / 4 + 0.5) / 4;
        const std::array<double, 4> w{(1 - p) * (1 - q), p * (1 - q), p * q, (1 - p) * q};
        Vec3 at = -centre;
        double W = 0;
        for (std::size_t c = 0; c < 4; ++c) {
          at += w[c] * x[c];
          W += w[c] * w[c] * inverse_mass(face[c]);
        }
        const double g = radius_ - at.norm();
        if (g <= 0) continue;
        const double J = std::min(k_ * g * dt, g / (16 * dt * W));
        up -= J * at.z() / at.norm();
        for (std::size_t c = 0; c < 4; ++c) push[c] += J * w[c] * inverse_mass(face[c]) / at.norm() * at;
      }
      for (std::size_t c = 0; c < 4; ++c)
        if (push[c] != Vec3::Zero()) pushes_.push_back({face[c], push[c]});
    }
    model_.push(pushes_, dt);
    pushes_.clear();
    force = up / dt;
  }

 private:
  double inverse_mass(Index node) const { return model_.body().inverse_mass[static_cast<std::size_t>(node)]; }

  physics::BodyModel& model_;
  double radius_, area_, k_;
  std::vector<std::array<Index, 4>> faces_;
  std::vector<physics::NodalPush> pushes_;
};

}  // namespace

bool Pressed::is_monotone() const { return std::ranges::is_sorted(force); }

Pressed press(const SpherePress& how) {
  DrivenBody block(quarter_block(how), Precision::single_);
  block.drive([](const Vec3& x) { return (x.x() < 1e-6 ? 1U : 0U) | (x.y() < 1e-6 ? 2U : 0U); });  // symmetry
  Sphere sphere(block.model(), how.radius, how.edge);
  block.share = 0.4;  // of the stable step, for the stiffness of the contact
  block.after_step = [&](double dt) { sphere.meet(dt); };
  Pressed result;
  const Stopwatch watch;
  const int stages = static_cast<int>(std::lround(SpherePress::deepest / SpherePress::stage));
  for (int n = 0; n < stages; ++n) {
    constexpr double seconds = 0.01;
    block.run(seconds, [&](const Vec3&, double t) {
      sphere.depth = (n + t / seconds) * SpherePress::stage;
      return Vec3(Vec3::Zero());
    });
    const int most_steps = static_cast<int>(10 / how.edge);  // a wave takes as many more as cells are smaller
    result.at_rest = block.settle(n + 1 < stages ? 1e-6 : 1e-7, most_steps) && result.at_rest;
    result.force.push_back(4 * sphere.force);
  }
  result.cpu_s = watch.cpu_s();
  result.steps = block.steps();
  const physics::BodyCounts counts = block.model().counts();
  result.cells = counts.elements;
  result.least_corner_J = counts.least_corner_J;
  return result;
}

}  // namespace palpate::bench
