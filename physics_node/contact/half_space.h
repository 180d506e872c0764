#pragma once
// What a body would answer a small tool with if it were deep and wide.

#include "physics_node/body/body.h"

namespace palpate::physics {

/// Of its own material.
inline double half_space_poisson_ratio(const Body& body) noexcept {
  constexpr double of_springs = 1.0 / 3.0;
  if (body.solid) return body.solid->poisson_ratio;
  if (body.mesh && !body.mesh->springs) return body.mesh->model.materials.front().poisson_ratio;
  return of_springs;
}

/// E / (1 - nu^2) of its own material [Pa].
inline double half_space_modulus(const Body& body) noexcept {
  const double nu = half_space_poisson_ratio(body);
  return body.law.modulus / (1 - nu * nu);
}

/// Under a round patch of radius a [N/m].
inline double half_space_stiffness(const Body& body, double a) noexcept {
  return 2 * half_space_modulus(body) * a;
}

}  // namespace palpate::physics
