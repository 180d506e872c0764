// A bar that hangs from its upper end comes to rest: where it stops, against the equilibrium of its own lattice.
//
//   K(u) u = m g,  solved by lattice_statics; the damper c = (2 / w_1) k1 makes the slowest oscillation,
//   w_1 = pi / (2 H) sqrt(E / rho), critical, so that after T = 34 / w_1 less than 1e-13 of it is left
//
// Error: largest difference in displacement, relative to the largest displacement.

#include <cmath>
#include <numbers>

#include "bench/problems/lattice_statics.h"
#include "bench/problems/problems.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {

Outcome bar_stretch(const Settings& settings, LatticeKind lattice) {
  constexpr double E = 10e3, rho = 1000, width = 0.02, H = 0.05, spacing = 0.005;
  const double w_1 = std::numbers::pi / (2 * H) * std::sqrt(E / rho);
  Scene scene = empty_scene();
  MaterialSpec& tissue = scene.materials[0];
  tissue.mass.reset(), tissue.k1.reset();
  tissue.density = rho;
  tissue.modulus = E;
  tissue.viscosity_bulk = 2 / w_1 * E;
  scene.gravity = Vec3(0, 0, -2);
  scene.bodies = {box_body(lattice, Vec3(width, width, H), spacing)};
  scene.bodies[0].fixed_faces[5] = true;  // +z
  constexpr int frames = 20;
  apply(settings, 34 / w_1, frames, scene);
  physics::World world(scene);
  const physics::BodyModel& body = world.body(0);
  Outcome outcome = run(world, frames);

  const Eigen::Matrix3Xd exact = equilibrium(body.body(), scene.gravity);
  double worst = 0;
  for (Eigen::Index n = 0; n < exact.cols(); ++n)
    worst = std::max(
        worst,
        (body.displacement(body.body().lattice.masses[static_cast<std::size_t>(n)]) - exact.col(n)).norm());
  outcome.error = worst / exact.colwise().norm().maxCoeff();
  return outcome;
}

}  // namespace palpate::bench
