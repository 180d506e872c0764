#pragma once
// A surface beside a tool as the hand feels it, before and while it is touched: a bed of springs behind a plane.
//
//   F = K_o d n,    M = r x F,    d = -gap
//   K_t = K_o (g g^T + h h^T),    g = (n, r x n),   h = (0, s x n)     about the tip
//
// n out of the tissue, r from the tip to where the force acts, s the standard deviation of the springs along the tool: what
// turns the tool about an axis beside n. What slides along the plane, or turns about n or about the tool itself, is free.
// Source: Astley & Hayward 1998 (Norton equivalents); the bed for rotations is ours.

#include "common/math/six.h"
#include "common/math/vec3.h"

namespace palpate::physics {

struct NortonSpring {
  Vec3 normal = Vec3::UnitZ();  // n, unit
  double gap = 0;               // of the tool above the plane at zero force; below 0: pressed in [m]
  double stiffness = 0;         // K_o [N/m]
  Vec3 arm = Vec3::Zero();      // r [m]
  Vec3 spread = Vec3::Zero();   // s [m]

  Mat6 tangent() const noexcept;  // K_t
};

}  // namespace palpate::physics
