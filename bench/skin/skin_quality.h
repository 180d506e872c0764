#pragma once
// How good a skin of an image is: how far from where the tissue ends, whether it is closed, and whether it goes
// through itself.

#include "physics_node/body/cells.h"
#include "physics_node/boundary/surface.h"

namespace palpate::bench {

struct SkinQuality {
  std::size_t vertices = 0, triangles = 0;
  double mean = 0, p99 = 0, most = 0;  // of vertices from the border of the tissue, in cells
  double normal_mean = 0;              // of triangles, from the gradient of the image there [deg]
  std::size_t open_edges = 0;          // not passed as often one way as the other
  std::size_t edges_of_four = 0;
  std::size_t bad_vertices = 0;   // whose facets do not hang together
  std::size_t intersections = 0;  // triangles that go through one without a common corner
};

/// The border is where the intensity, linear along each axis between the centres of cells, leaves [lo, hi].
/// Cost: seconds for 300,000 triangles.
SkinQuality skin_quality(const physics::Surface& surface, const physics::Cells& cells, double lo, double hi);

}  // namespace palpate::bench
