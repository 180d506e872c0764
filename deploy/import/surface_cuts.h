#pragma once
// Where triangles of a surface go through each other.

#include <optional>

#include "deploy/import/triangle_tree.h"

namespace palpate {

struct SurfaceCuts {
  std::size_t triangles = 0;          // that go through another one of their part
  Vec3 first = Vec3::Zero();          // a corner of the first of them [m]
  std::optional<Vec3> between_parts;  // a corner of the first that goes through another part
};

/// Looks whether an edge of one goes through the inside of another, for all pairs without a common edge. What only touches, or lies in
/// the plane of the other, is not seen.
/// @param part  of each triangle
SurfaceCuts cuts_of(const TriangleSurface& surface, const TriangleTree& tree,
                    const std::vector<std::size_t>& part);

}  // namespace palpate
