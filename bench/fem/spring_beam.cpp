#include "bench/fem/spring_beam.h"

#include <cmath>

#include "bench/problems/hex_beam.h"
#include "bench/problems/lattice_statics.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"

namespace palpate::bench {

SpringBeam spring_beam(int cells) {
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.modulus = HexBeam::modulus;
  tissue.density = HexBeam::density;
  BodySpec spec;
  spec.name = "beam";
  spec.lattice = LatticeKind::voxel;
  const double edge = HexBeam::height / cells;
  spec.spacing = edge;
  spec.material = "tissue";
  spec.shape = BoxShape{{HexBeam::length, HexBeam::height, HexBeam::height}};
  spec.fixed_faces[0] = true;  // -x
  const physics::Body body = physics::build_body(spec, tissue);
  const Eigen::Matrix3Xd u = linear_equilibrium(body, {0, 0, -HexBeam::gravity});
  double sunk = 0, n = 0, far = 0;
  for (const physics::Index mass : body.lattice.masses)
    far = std::max(far, body.lattice.rest_position(mass).x());
  for (std::size_t m = 0; m < body.lattice.masses.size(); ++m) {
    if (body.lattice.rest_position(body.lattice.masses[m]).x() < far - 0.1 * edge) continue;
    sunk -= u(2, static_cast<Eigen::Index>(m));
    n += 1;
  }
  constexpr double poisson_ratio = 0.25;  // of springs between the neighbours of a cube
  return {sunk / n / HexBeam({.cells = 2, .poisson_ratio = poisson_ratio}).timoshenko()};
}

}  // namespace palpate::bench
