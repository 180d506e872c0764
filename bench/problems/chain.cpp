// A standing wave on a chain of N equal elements with held ends, against the dispersion relation of the lattice.
//
//   u_n(t) = A sin(j pi n / N) cos(w t),   w = 2 sqrt(spring / mass) sin(j pi / (2 N))
//
// The chain is the diagonal of one layer of a face-centred lattice of which all other masses are held: the elements
// beside it stand at right angles and act only in third order of A / edge. The frequency is read from the wave's amplitude
// a_n at regular times by the recurrence a_(n+1) + b a_(n-1) = 2 c a_n of any damped cosine, w = acos(c / sqrt b) / tau,
// with b and c fitted to all samples. Error: relative difference in w.

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/problems/problems.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {
namespace {

constexpr double spring = 1000, mass = 1, edge = 1;

Scene chain_scene(int n) {
  Scene scene = empty_scene();
  scene.materials[0].mass = mass;
  scene.materials[0].k1 = spring;
  const double step = edge / std::numbers::sqrt2;
  const double side = (n + 0.1) * step;
  scene.bodies = {box_body(LatticeKind::fcc, Vec3(side, side, 0.1), edge)};
  const auto hold = [&](double x0, double x1, double y) {  // in steps
    scene.bodies[0].fixed_boxes.push_back(
        {Vec3(x0 * step, (y - 0.2) * step, -1), Vec3(x1 * step, (y + 0.2) * step, 1)});
  };
  for (int j = 0; j <= n; ++j) hold(-1, j - 0.5, j), hold(j + 0.5, n + 1, j);
  hold(-0.5, 0.5, 0), hold(n - 0.5, n + 0.5, n);
  return scene;
}

/// Frequency of the damped cosine of which these are samples, tau apart.
double frequency(const std::vector<double>& a, double tau) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t i = 1; i + 1 < a.size(); ++i) {
    const Eigen::Vector2d row(2 * a[i], -a[i - 1]);
    normal += row * row.transpose();
    right += row * a[i + 1];
  }
  const Eigen::Vector2d fit = normal.ldlt().solve(right);
  return std::acos(fit[0] / std::sqrt(fit[1])) / tau;
}

}  // namespace

Outcome chain_wave(const Settings& settings, int n, int mode) {
  constexpr double A = 1e-4;  // [m]
  const double q = mode * std::numbers::pi / n;
  const double w = 2 * std::sqrt(spring / mass) * std::sin(q / 2);
  constexpr int periods = 10, frames = 12 * periods;
  const double T = periods * 2 * std::numbers::pi / w;
  Scene scene = chain_scene(n);
  apply(settings, T, frames, scene);
  physics::World world(scene);
  physics::BodyModel& body = world.body(0);
  std::vector<physics::Index> cells;
  for (int i = 0; i <= n; ++i) {
    cells.push_back(body.body().lattice.mass_at({i, i, 0}));
    body.place(cells.back(), A * std::sin(q * i) * pair_axis(), Vec3::Zero());
  }
  world.restart_ledger();
  std::vector<double> amplitude;
  Outcome outcome = run(world, frames, [&](int) {
    double sum = 0;
    for (int i = 0; i <= n; ++i)
      sum += std::sin(q * i) * body.displacement(cells[static_cast<std::size_t>(i)]).dot(pair_axis());
    amplitude.push_back(sum);
  });
  outcome.error = std::abs(frequency(amplitude, T / frames) - w) / w;
  return outcome;
}

}  // namespace palpate::bench
