#pragma once
// The project's own file of tetrahedra: HDF5, in metres. docs/volume_file.md has its datasets.

#include <string>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

struct MeshFile {
  TetMesh mesh;        // of first order, tidy
  std::string source;  // file name (no folder) that it came from
};

/// Does the name say that it is one? Others are of Gmsh's format.
bool is_mesh_file_name(const std::string& path);
/// Is it HDF5, and does it say that it is a mesh?
bool is_mesh_file(const std::string& path);

/// Writes beside, then renames: `path` is either complete or untouched. @throws InputError: cannot be written
void write_mesh(const std::string& path, const MeshFile& file);

/// @throws InputError: missing, cut short, no mesh of palpate, other version, absurd sizes, a place that is not finite or beyond 1000 m, a
///   tetrahedron that is flat or inside out or names a node that is not there, a node that none has
MeshFile read_mesh(const std::string& path);

}  // namespace palpate::physics
