#pragma once
// [[wall]] and [contact] of a scene: what bodies meet besides tools.

#include "common/math/vec3.h"

namespace palpate {

/// A fixed plane; tissue stays on the side that the normal points to.
struct WallSpec {
  Vec3 point = Vec3::Zero();    // world [m]
  Vec3 normal = Vec3::UnitZ();  // of length 1
};

/// How bodies, and the fragments of bodies, touch each other.
///   paper  mass against mass at L / sqrt(3), whatever the stretch                              P0
///   swept  mass against facet, at a distance that follows the stretch, along the whole step
enum class ContactDistance { paper, swept };
struct ContactSpec {
  bool enabled = true;
  ContactDistance distance = ContactDistance::swept;
  double restitution = 1;       // relative speed after over before, [0, 1]
  bool count_passages = false;  // count masses that pass through facets
};

}  // namespace palpate
