#pragma once
// The stiffness of a hexahedron near rest, as a matrix: for bounds and references, not for stepping.

#include <Eigen/Core>

#include "physics_node/step/fem/hex_constants.h"

namespace palpate::physics {

using HexMatrix = Eigen::Matrix<double, 24, 24>;  // by corner, then component

/// By central differences of the forces, so that it is theirs whatever they are; symmetric to rounding [N/m].
HexMatrix hex_stiffness(const HexMaterial& material, const Vec3& edge);

}  // namespace palpate::physics
