#pragma once
// What a surface encloses at rest.

#include "physics_node/boundary/surface.h"

namespace palpate::physics::test {

/// By the divergence theorem: sum over triangles of a . (b x c) / 6. [m^3]
inline double volume_inside(const Surface& surface) {
  double six = 0;
  for (const auto& f : surface.facets) {
    six += surface.rest[f[0]].dot(surface.rest[f[1]].cross(surface.rest[f[2]]));
    six += surface.rest[f[0]].dot(surface.rest[f[2]].cross(surface.rest[f[3]]));
  }
  return six / 6;
}

}  // namespace palpate::physics::test
