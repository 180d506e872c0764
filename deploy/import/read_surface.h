#pragma once
// Surfaces that other programs write, through assimp.

#include <string>

#include "deploy/import/triangle_surface.h"

namespace palpate {

/// By the ending of a name: .obj, .stl, .ply, .off.
bool is_surface_format(const std::string& path);

struct SurfaceContent {
  TriangleSurface surface;   // points may be there more than once: formats repeat them for each triangle
  std::size_t polygons = 0;  // with more than three corners, which were cut into triangles
  std::size_t other = 0;     // points and lines, which are not kept
};

/// What reading takes at most for each byte of the file: assimp's scene, and what is made of it.
inline constexpr double surface_bytes_a_byte = 60;

/// Reads no other file: materials that this one names are left out. Places have the precision of float.
/// @param metres  that one unit of the file has
/// @throws InputError: it cannot be read, is cut off, has a place that is not finite or beyond 1000 m, or no triangle; one line
SurfaceContent read_surface(const std::string& path, double metres);

}  // namespace palpate
