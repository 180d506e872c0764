#pragma once
// Where a body of finite elements rests under its weight, found without stepping.

#include "physics_node/step/multigrid/newton.h"

namespace palpate::physics {

struct Equilibrium {
  std::vector<Vec3>
      displacement;     // by node of the body, in the order of body.nodes(): where the search ended [m]
  NewtonReport report;  // of all that was tried
};

/// Newton's method without inertia, from rest. Where that does not arrive, the way that a thick liquid would take: steps of time
/// whose velocity is forgotten, longer while they go well. In double. Something must be held.
/// Cost: about 3 us a cell; some times as much where the body folds. Allocates.
Equilibrium equilibrium(const Body& body, const Vec3& gravity, const Crew& crew = {});

}  // namespace palpate::physics
