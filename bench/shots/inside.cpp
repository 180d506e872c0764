#include "bench/shots/inside.h"

#include "physics_node/collision/candidates.h"
#include "physics_node/collision/point_triangle.h"
#include "physics_node/lattice/triangles.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {

using namespace physics;

std::vector<Index> surface_of(const BodyModel& body) { return Candidates(body, true).cell(); }

int count_inside(const BodyModel& inner, std::span<const Index> masses, const BodyModel& outer) {
  const Lattice& lattice = outer.body().lattice;
  const auto mask = [&](Index cell) { return outer.adjacency().live_elements(cell); };
  const auto patterns = triangle_patterns(lattice);
  std::vector<Triangle> surface;
  for (const Index cell : lattice.masses)
    for (const TrianglePattern& t : patterns[static_cast<std::size_t>(lattice.row_kind(cell))])
      if (is_boundary(t, cell, mask))
        surface.push_back(
            {outer.position(cell), outer.position(cell + t.corner[0]), outer.position(cell + t.corner[1])});
  // In no plane of a lattice, and farther than any body.
  const std::array<Vec3, 3> rays = {Vec3(61, 37, 71), Vec3(-53, 67, 43), Vec3(29, -73, -59)};
  const Triangle stands = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  int inside = 0;
  for (const Index cell : masses) {
    int odd = 0;
    for (const Vec3& ray : rays) {
      int hits = 0;
      for (const Triangle& t : surface) hits += passes_through(inner.position(cell), ray, t, stands) ? 1 : 0;
      odd += hits % 2;
    }
    inside += odd >= 2 ? 1 : 0;
  }
  return inside;
}

}  // namespace palpate::bench
