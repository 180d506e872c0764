#pragma once
// The project's own file of a closed surface of triangles: HDF5, in metres. docs/volume_file.md has its datasets.

#include <string>

#include "physics_node/mesh/triangle_mesh.h"

namespace palpate::physics {

struct SurfaceFile {
  TriangleMesh mesh;
  std::string source;  // file name (no folder) that it came from
};

/// Is it HDF5, and does it say that it is a surface?
bool is_surface_file(const std::string& path);

/// Writes beside, then renames: `path` is either complete or untouched. @throws InputError: cannot be written
void write_surface(const std::string& path, const SurfaceFile& file);

/// @throws InputError: missing, cut short, no surface of palpate, other version, absurd sizes, a place that is not
/// finite
///   or beyond 1000 m, a triangle that names a node that is not there, and what check_surface() refuses
SurfaceFile read_surface_file(const std::string& path);

/// What no body of springs can be made of: a triangle without area, an edge that has not one triangle on either side, a
/// node of no triangle, a surface that is inside out or encloses nothing.
/// @param where  begins the complaint
/// @throws InputError
void check_surface(const TriangleMesh& mesh, const std::string& where);

}  // namespace palpate::physics
