#pragma once
// A facet where its corners are now.

#include "physics_node/collision/facets.h"
#include "physics_node/collision/point_triangle.h"

namespace palpate::physics {

struct FacetNow {
  Triangle corner{};  // [m]
  double edge = 0;    // mean length of its edges; L for a loose mass [m]
};

inline FacetNow facet_now(const Candidates& of, const Facets::Corners& k) noexcept {
  FacetNow now{{of.x()[k[0]], of.x()[k[1]], of.x()[k[2]]}, of.length()};
  if (k[0] != k[1])
    now.edge = ((now.corner[0] - now.corner[1]).norm() + (now.corner[1] - now.corner[2]).norm() +
                (now.corner[2] - now.corner[0]).norm()) /
               3;
  return now;
}

}  // namespace palpate::physics
