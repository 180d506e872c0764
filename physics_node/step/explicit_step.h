#pragma once
// What a step of a body is asked to do.

#include <span>

#include "common/math/vec3.h"
#include "physics_node/step/plane.h"
#include "physics_node/step/team.h"

namespace palpate::physics {

struct ExplicitStep {
  double dt = 0;  // [s]
  // For how many steps of dt elements act now, as step/strides.h says: other than 1 only of tetrahedra.
  int acts_for = 1;
  Vec3 gravity = Vec3::Zero();  // [m/s^2]
  Team* team = nullptr;         // null: no team
  int threads = 1;              // of the team that this step may use
  bool verlet = false;          // velocity_verlet; else symplectic Euler
  bool watch = false;           // note speeds, accelerations and energies: Books::watch(), sleep
  bool exact = false;           // book dampers exactly, where velocities may jump: see lattice/element_step.h
  bool struck = false;          // velocities may jump at the end of this step, or did at that of the last
  // Only of backward_euler, whose step ends on the right side of them; other integrators bounce off afterwards:
  std::span<const Plane> planes = {};
  double restitution = 1;
};

}  // namespace palpate::physics
