#pragma once
// What a file gives as triangles becomes a surface that has an inside, or it is said why it has none.

#include <string>

#include "deploy/import/triangle_surface.h"

namespace palpate {

struct SurfaceMended {
  std::size_t welded = 0;      // points that lay within rounding of another, but not on it
  std::size_t degenerate = 0;  // triangles with two corners at one point, left out
  std::size_t unused = 0;      // points of no triangle, left out
  std::size_t turned = 0;      // triangles that were the other way round
  std::size_t cutting = 0;     // triangles that go through others of their part; they stay
  Vec3 cut = Vec3::Zero();     // a corner of the first of them [m]
};

struct ClosedSurface {
  TriangleSurface surface;  // anticlockwise from outside
  std::size_t parts = 0;    // that hang together over edges; one within another is a hole in it
  double volume = 0;        // enclosed [m^3]
  SurfaceMended mended;
};

/// Points at one place become one, then every edge must have two triangles. Parts are turned by which lies in which.
/// @param where  begins complaints
/// @throws InputError: an edge with one triangle or with more than two, a surface with one side, parts that go through each other, or
///   one that encloses nothing; one line with the first place in mm, and how many
ClosedSurface close_surface(TriangleSurface surface, const std::string& where);

}  // namespace palpate
