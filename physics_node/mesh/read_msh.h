#pragma once
// Gmsh's format MSH 2.2 in ASCII, of which the tetrahedra with four nodes are kept.

#include <string>
#include <string_view>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

struct MshContent {
  TetMesh mesh;           // region: the physical group of each tetrahedron, 0 without one
  Tidied tidied;          // what had to be mended
  std::size_t other = 0;  // points, lines and faces, which are not kept
};

/// Most that a file may have. Why: more than any machine steps, and less than an Index counts.
inline constexpr std::size_t most_mesh_nodes = 20'000'000, most_mesh_tets = 60'000'000;
inline constexpr double farthest_mesh_node = 1000;  // along any axis [m]

/// @param metres  that one unit of the file has
/// @throws InputError: it cannot be read, is another format, breaks off, names a node that it does not have, has a place that is
///   not finite or beyond 1000 m, a flat tetrahedron, a volume of another kind, or no tetrahedron; one line with
///   file:line:column
MshContent read_msh(const std::string& path, double metres = 1);

/// The same of a text. @param name  of the file, for messages
MshContent parse_msh(std::string_view text, const std::string& name, double metres = 1);

}  // namespace palpate::physics
