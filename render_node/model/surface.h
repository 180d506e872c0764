#pragma once
// A complete visible surface of one body, put together from BodySurface chunks and changed by SurfaceChange pages.

#include <array>
#include <cstdint>
#include <vector>

#include "common/message/messages.h"

namespace palpate::render {

using Corners =
    std::array<std::uint32_t, 4>;  // counter-clockwise seen from outside; a triangle repeats its last

/// Without an area: an element (a, b, b, b) or a mass (a, a, a, a) that no other facet shows.
inline bool is_loose(const Corners& c) { return c[1] == c[3]; }
inline bool is_mass(const Corners& c) { return c[0] == c[1] && is_loose(c); }

struct Surface {
  std::uint32_t body = 0;
  std::uint32_t revision = 0;  // 0: none yet
  bool rigid = false;
  std::uint32_t facets_hidden = 0;  // of the whole body, never sent
  std::vector<Array3f> position;    // [m]                     (n_vertices)
  std::vector<Corners> corners;     // each < n_vertices       (n_facets)
  std::vector<std::uint32_t> rgba;  // 0xAABBGGRR              (n_facets)
};

}  // namespace palpate::render
