#pragma once
// The constants of a hexahedron, from its material and its edges.

#include "common/math/vec3.h"
#include "common/scene/element_kinds.h"
#include "physics_node/material/lame.h"
#include "physics_node/step/fem/hex_element.h"

namespace palpate::physics {

struct HexMaterial {
  double modulus = 0;        // Young's [Pa]
  double poisson_ratio = 0;  // below 0.5
  HourglassKind hourglass = HourglassKind::physical;
  /// kappa: stiffness of all hourglass modes alike, in shear moduli. Why: what the physical terms leave free, a mode that couples to
  /// none of them far from rest; 0.05 stiffens a beam two cells thick by 1.5 %. Alone, 0.5 comes nearest to bending at
  /// four cells and more, and is 10 % too soft at two.
  double every = hourglass == HourglassKind::physical ? 0.05 : 0.5;
};

/// @param edge  of the cell, along x, y, z [m]
template <class Real>
HexConstants<Real> hex_constants(const HexMaterial& material, const Vec3& edge) {
  const double E = material.modulus, nu = material.poisson_ratio;
  const Lame lame = lame_of(E, nu);
  const double V = edge.prod();
  HexConstants<Real> k;
  k.mu = static_cast<Real>(lame.mu);
  k.lambda = static_cast<Real>(lame.lambda);
  k.volume = static_cast<Real>(V);
  for (std::size_t i = 0; i < 3; ++i) {
    const double h_i = edge[static_cast<Eigen::Index>(i)];
    k.per_4h[i] = static_cast<Real>(1 / (4 * h_i));
    for (std::size_t j = 0; j < 3; ++j) {
      const double h_j = edge[static_cast<Eigen::Index>(j)];
      k.bend[i][j] = static_cast<Real>((i == j ? 1 : nu) * E / (1 - nu * nu) * V / (48 * h_i * h_j));
      k.twist[i][j] = static_cast<Real>(lame.mu * V / (48 * h_i * h_j));
    }
  }
  k.every = static_cast<Real>(material.every * lame.mu * V / 48 * edge.cwiseInverse().squaredNorm());
  return k;
}

}  // namespace palpate::physics
