#pragma once
// Gmsh's format MSH 2.2 in ASCII, as read_msh.h reads it.

#include <string>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

/// Places with nine digits. @param mesh  of first order; @param metres  that one unit of the file has
std::string msh_text(const TetMesh& mesh, double metres);

/// Writes that; a reader sees the old file or the whole new one. @throws InputError: cannot be written
void write_msh(const std::string& path, const TetMesh& mesh, double metres);

}  // namespace palpate::physics
