#pragma once
// Floor and walls, as bodies meet them.

#include <cstdint>

#include "common/math/vec3.h"

namespace palpate::physics {

/// A fixed plane; tissue stays where n . x >= height.
struct Plane {
  Vec3 n = Vec3::UnitZ();
  double height = 0;  // [m]
};

/// Bit k: the k-th plane of a scene, which has a floor and sixteen walls at most.
using PlaneSet = std::uint32_t;

}  // namespace palpate::physics
