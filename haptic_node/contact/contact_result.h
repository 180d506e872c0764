#pragma once
// What a local model makes the hand feel in a tick.

#include <cstdint>

#include "common/math/vec3.h"

namespace palpate::haptic {

struct ContactResult {
  Vec3 force = Vec3::Zero();   // on the hand [N]; exactly zero in free space
  Vec3 torque = Vec3::Zero();  // on the hand, about the tip [N m]
  Vec3 proxy = Vec3::Zero();   // [m]
  double depth = 0;            // from hand to the planes' common surface [m]
  double stored = 0;           // in the springs [J]
  std::uint32_t n_planes = 0;  // that push; a wrench counts as one
  bool outran = false;         // the hand has left the neighbourhood that the newest message covers
};

}  // namespace palpate::haptic
