#pragma once
// Vectors of nodes in fours: x, y, z and one more, so that one is loaded at once.

#include "common/math/vec3.h"
#include "physics_node/step/zeroed_array.h"

namespace palpate::physics {

template <class Real>
Vec3 vector_at(const ZeroedArray<Real>& four, std::size_t node) noexcept {
  return {static_cast<double>(four[4 * node]), static_cast<double>(four[4 * node + 1]),
          static_cast<double>(four[4 * node + 2])};
}

template <class Real>
void set_vector(ZeroedArray<Real>& four, std::size_t node, const Vec3& x) noexcept {
  for (std::size_t a = 0; a < 3; ++a) four[4 * node + a] = static_cast<Real>(x[static_cast<Eigen::Index>(a)]);
}

}  // namespace palpate::physics
