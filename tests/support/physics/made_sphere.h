#pragma once
// A sphere of triangles as even as a sphere has them.

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "physics_node/mesh/triangle_mesh.h"

namespace palpate::test {

using physics::Index;
using physics::MeshTriangle;
using physics::TriangleMesh;

/// An icosahedron whose triangles are cut in four so many times, with its corners on the sphere. (20 * 4^cuts
/// triangles)
inline TriangleMesh made_sphere(double radius, int cuts) {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  TriangleMesh mesh;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g})
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 x = Vec3::Zero();
        x[axis] = a, x[(axis + 1) % 3] = b;
        mesh.nodes.push_back(radius * x.normalized());
      }
  // Triangles of nodes at the distance of neighbours, anticlockwise from outside.
  const double edge = 2.0001 / std::sqrt(1 + g * g) * radius;
  const auto at = [&](Index n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
  for (Index a = 0; a < 12; ++a)
    for (Index b = 0; b < 12; ++b)
      for (Index c = 0; c < 12; ++c) {
        if (a > b || a > c || a == b || b == c || a == c) continue;
        if ((at(a) - at(b)).norm() > edge || (at(b) - at(c)).norm() > edge || (at(c) - at(a)).norm() > edge)
          continue;
        if ((at(b) - at(a)).cross(at(c) - at(a)).dot(at(a)) > 0) mesh.triangles.push_back({a, b, c});
      }
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [found, is_new] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<Index>(mesh.nodes.size()));
      if (is_new) mesh.nodes.push_back(radius * (at(a) + at(b)).normalized());
      return found->second;
    };
    std::vector<MeshTriangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const MeshTriangle& t : {MeshTriangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(t);
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

}  // namespace palpate::test
