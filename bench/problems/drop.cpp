// Two transients without a closed form, against the same scene in double precision at a tiny step (velocity Verlet, 1/64
// of the stable step: its own error is some 1e-5 of that of the coarsest step in the sweep).
//
//   drop     a cube of soft tissue, held at its bottom, feels its weight from t = 0 on and rings
//   vessel   a bar 1 x 10 x 1 voxels, both ends held, pushed aside by hand and released; it has a damper
//
// Error: root mean square difference in position at the end, relative to the root mean square displacement.

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "bench/problems/problems.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"

namespace palpate::bench {
namespace {

using Placement = std::function<void(physics::World&)>;

Eigen::Matrix3Xd displacements(const physics::World& world) {
  const auto& body = world.body(0);
  Eigen::Matrix3Xd u(3, body.body().lattice.n_masses());
  for (Eigen::Index n = 0; n < u.cols(); ++n)
    u.col(n) = body.displacement(body.body().lattice.masses[static_cast<std::size_t>(n)]);
  return u;
}

struct Run {
  Outcome outcome;
  Eigen::Matrix3Xd u;
};

Run run_transient(Scene scene, const Settings& settings, double seconds, const Placement& start) {
  constexpr int frames = 20;
  apply(settings, seconds, frames, scene);
  physics::World world(scene);
  start(world);
  world.restart_ledger();
  Run result;
  result.outcome = run(world, frames);
  result.u = displacements(world);
  return result;
}

/// The answer to compare with, found once for each scene.
const Eigen::Matrix3Xd& reference(const std::string& name, const Scene& scene, double seconds,
                                  const Placement& start) {
  static std::map<std::string, Eigen::Matrix3Xd> known;
  auto found = known.find(name);
  if (found == known.end()) {
    const double stable = physics::World(scene).stable_step_seconds();
    const Settings tiny{Integrator::velocity_verlet, Precision::double_, stable / 64, 1};
    found = known.emplace(name, run_transient(scene, tiny, seconds, start).u).first;
  }
  return found->second;
}

Outcome compare(const std::string& name, const Scene& scene, const Settings& settings, double seconds,
                const Placement& start) {
  const Eigen::Matrix3Xd& exact = reference(name, scene, seconds, start);
  Run result = run_transient(scene, settings, seconds, start);
  result.outcome.error = (result.u - exact).norm() / exact.norm();
  return result.outcome;
}

Scene tissue_scene() {
  Scene scene = empty_scene();
  scene.materials[0].mass.reset(), scene.materials[0].k1.reset();
  scene.materials[0].density = 1000;
  scene.materials[0].modulus = 10e3;
  return scene;
}

}  // namespace

Outcome cube_drop(const Settings& settings, LatticeKind lattice, double spacing) {
  Scene scene = tissue_scene();
  scene.gravity = Vec3(0, 0, -9.81);
  scene.bodies = {box_body(lattice, Vec3::Constant(0.05), spacing)};
  scene.bodies[0].fixed_faces[4] = true;  // -z
  const std::string name =
      "drop " + std::to_string(static_cast<int>(lattice)) + " " + std::to_string(spacing);
  return compare(name, scene, settings, 0.05, [](physics::World&) {});
}

Outcome vessel_release(const Settings& settings) {
  Scene scene = tissue_scene();
  scene.materials[0].viscosity_bulk = 20;
  scene.bodies = {box_body(LatticeKind::voxel, Vec3(0.1, 1.0, 0.1), 0.1)};
  scene.bodies[0].fixed_faces[2] = scene.bodies[0].fixed_faces[3] = true;  // -y, +y
  return compare("vessel", scene, settings, 1.0, [](physics::World& world) {
    auto& body = world.body(0);
    for (const physics::Index cell : body.body().lattice.masses) {
      const double y = body.body().lattice.rest_position(cell).y();
      const double s = std::sin(std::numbers::pi * y);
      body.place(cell, Vec3(0.05 * s * s, 0, 0), Vec3::Zero());
    }
  });
}

}  // namespace palpate::bench
