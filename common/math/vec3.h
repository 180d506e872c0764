#pragma once
// A vector of the world.

#include <Eigen/Core>

namespace palpate {

using Vec3 = Eigen::Vector3d;

}  // namespace palpate
