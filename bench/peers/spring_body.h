#pragma once
// A body of springs as plain arrays, the way every peer can read it: the very masses and elements that palpate steps.

#include <cstdint>
#include <vector>

#include "common/math/vec3.h"
#include "physics_node/body/body.h"

namespace palpate::bench {

struct Spring {
  std::size_t i = 0, j = 0;  // masses
  double k = 0;              // [N/m]
  double length = 0;         // at rest [m]
};

struct SpringBody {
  std::vector<Vec3> rest;          // [m]                         (n_masses, in palpate's order: along rows)
  std::vector<std::uint8_t> held;  // 1: does not move            (n_masses)
  std::vector<Spring> springs;     // none between two held masses, in the order of their first mass
  double mass = 0;                 // of every mass [kg]
  Vec3 gravity = Vec3::Zero();     // [m/s^2]

  double longest() const;  // rest length [m]
};

/// @param body  without damper and yield: what all peers can express
SpringBody spring_body(const physics::Body& body, const Vec3& gravity);

}  // namespace palpate::bench
