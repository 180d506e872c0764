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
/// whose velocity is forgotten, longer while they go well. No node passes a plane. Where nothing is held, planes must carry it: it is let
/// down along gravity to the first that it meets, and then takes the liquid's way at once, since without friction
/// nothing resists what slides along a floor. In double.
/// Cost: about 3 us a cell; some times as much where the body folds. Allocates.
Equilibrium equilibrium(const Body& body, const Vec3& gravity, std::span<const Plane> planes = {},
                        const Crew& crew = {});

/// How far it is along gravity to the first plane that a body at rest meets there; negative: it is behind that; infinite: there is
/// none. [m]
double way_down(const Body& body, const Vec3& gravity, std::span<const Plane> planes);

}  // namespace palpate::physics
