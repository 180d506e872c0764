#pragma once
// A facet where its corners are now.

#include <algorithm>

#include "physics_node/collision/facets.h"
#include "physics_node/collision/point_triangle.h"

namespace palpate::physics {

struct FacetNow {
  Triangle corner{};  // [m]
  double edge = 0;    // mean length of its edges, at most 2 L; L for a loose mass [m]
};

/// Contact distances follow the stretch of a facet up to this. One that is stretched further would feel masses all round a
/// tool, and the lists would have no end.
constexpr double most_felt_stretch = 2;

inline FacetNow facet_now(const Candidates& of, const Facets::Corners& k) noexcept {
  FacetNow now{{of.x()[k[0]], of.x()[k[1]], of.x()[k[2]]}, of.length()};
  if (k[0] != k[1])
    now.edge = std::min(most_felt_stretch * of.length(),
                        ((now.corner[0] - now.corner[1]).norm() + (now.corner[1] - now.corner[2]).norm() +
                         (now.corner[2] - now.corner[0]).norm()) /
                            3);
  return now;
}

}  // namespace palpate::physics
