#pragma once
// The nodes of a mesh where a scene wants them.

#include <Eigen/Geometry>
#include <vector>

#include "common/scene/body_spec.h"

namespace palpate::physics {

/// The middle of the box round them comes to the body's `at`, turned by its orientation.
inline void put_in_place(std::vector<Vec3>& nodes, const BodySpec& spec) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : nodes) box.extend(x);
  const Vec3 middle = box.center();
  for (Vec3& x : nodes) x = spec.at + spec.orientation * (x - middle);
}

}  // namespace palpate::physics
