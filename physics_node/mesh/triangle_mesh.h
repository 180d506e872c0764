#pragma once
// A closed surface of triangles as read or made: places and corners, no motion and no material.

#include <array>
#include <span>
#include <vector>

#include "common/math/vec3.h"
#include "physics_node/lattice/lattice_types.h"
#include "physics_node/mesh/mesh_parts.h"

namespace palpate::physics {

struct TriangleMesh {
  std::vector<Vec3> nodes;              // [m]
  std::vector<MeshTriangle> triangles;  // corners, anticlockwise from outside
};

/// By the divergence theorem; of a closed surface [m^3]
double enclosed_volume(const TriangleMesh& mesh) noexcept;

double area_of(const TriangleMesh& mesh, const MeshTriangle& corners) noexcept;  // [m^2]
/// A triangle whose area is below 1e-6 of the square of its longest edge: float cannot tell what it pulls at.
bool is_flat(const TriangleMesh& mesh, const MeshTriangle& corners) noexcept;

/// The outer faces of a mesh of tetrahedra and their nodes alone, which keep their order. @param mesh  of first order
TriangleMesh outer_surface(const TetMesh& mesh);

/// An edge and the triangles that have it.
struct MeshEdge {
  std::array<Index, 2> node{};      // the smaller number first
  std::array<Index, 2> triangle{};  // both
};
/// By the smaller node, then the other. @param mesh  every edge is of two triangles: see open_edges()
std::vector<MeshEdge> edges_of(const TriangleMesh& mesh);
/// Edges that do not have exactly one triangle on either side.
std::size_t open_edges(const TriangleMesh& mesh);

}  // namespace palpate::physics
