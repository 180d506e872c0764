#pragma once
// A mesh of tetrahedra as read or made: places and corners, no motion and no material.

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "common/math/vec3.h"
#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

struct TetMesh {
  std::vector<Vec3> nodes;                 // [m]
  std::vector<std::array<Index, 4>> tets;  // corners; turned so that the volume is positive
  std::vector<int> region;                 // of each tetrahedron: a number that the maker gave it
  /// Of second order: nodes in the middle of the edges 01, 12, 02, 03, 13, 23 of each. Empty: of first order.
  std::vector<std::array<Index, 6>> middles = {};
};

/// The corners of each edge of a tetrahedron, in the order of `middles`.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tet_edges = {
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

/// Corners of the faces of a tetrahedron whose volume is positive, anticlockwise from outside.
inline constexpr std::array<std::array<std::size_t, 3>, 4> tet_faces = {
    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

/// det [x1 - x0, x2 - x0, x3 - x0] / 6: negative where the corners are in the other order [m^3]
double signed_volume(const TetMesh& mesh, const std::array<Index, 4>& corners) noexcept;

/// Of all tetrahedra [m^3]
double volume_of(const TetMesh& mesh) noexcept;
/// Round all nodes.
Eigen::AlignedBox3d box_of(const TetMesh& mesh) noexcept;

/// Flat, or so nearly that float cannot tell: its volume is below 1e-9 of the cube of its longest edge. Of an equilateral
/// one that is 0.12; a sliver that still can be stepped has 1e-4.
bool is_flat(const TetMesh& mesh, const std::array<Index, 4>& corners) noexcept;

/// What `tidy` did.
struct Tidied {
  std::size_t turned = 0;  // tetrahedra whose volume was negative
  std::size_t unused = 0;  // nodes that no tetrahedron has
};

/// Turns tetrahedra so that volumes are positive, and drops nodes that none has; the others keep their order.
/// @param mesh  of first order; every corner names a node
Tidied tidy(TetMesh& mesh);

/// Makes a mesh of first order one of second: a node in the middle of each edge, after the others.
void add_middles(TetMesh& mesh);

}  // namespace palpate::physics
