#include "physics_node/lattice/triangles.h"

#include "common/error/error.h"

namespace palpate::physics {
namespace {

/// The volumes that a triangle bounds, each as its corners, those of the triangle first.
std::vector<std::vector<Vec3i>> volumes(const Surroundings& around, LatticeKind kind,
                                        const std::array<Vec3i, 3>& t) {
  std::vector<std::vector<Vec3i>> found;
  for (const Vec3i& apex : around.neighbours(t[0]))
    if (apex != t[1] && apex != t[2] && around.element(apex, t[1]) && around.element(apex, t[2]))
      found.push_back({t[0], t[1], t[2], apex});
  if (kind == LatticeKind::fcc) {
    // The octahedron: of its six masses each faces one of the triangle across the middle.
    PALPATE_CHECK(found.size() == 1, "a triangle of the fcc lattice bounds one tetrahedron");
    const Vec3i sum = t[0] + t[1] + t[2];
    const Vec3i apex = found[0][3];
    // Twice its centre, which lies as far beyond the triangle as the apex lies before it.
    const Vec3i twice = sum - apex;
    found.push_back({t[0], t[1], t[2], Vec3i(twice - t[0]), Vec3i(twice - t[1]), Vec3i(twice - t[2])});
  }
  return found;
}

}  // namespace

TrianglePatterns triangle_patterns(const Lattice& lattice) {
  TrianglePatterns patterns;
  for (int kind = 0; kind < Surroundings::kinds(lattice); ++kind) {
    const Surroundings around(lattice, kind);
    const auto near = around.neighbours(Vec3i::Zero());
    for (std::size_t a = 0; a < near.size(); ++a)
      for (std::size_t b = 0; b < near.size(); ++b) {
        const Index first = around.offset(near[a]);
        const Index second = around.offset(near[b]);
        if (first <= 0 || second <= first || !around.element(near[a], near[b])) continue;
        const std::array<Vec3i, 3> t{Vec3i::Zero(), near[a], near[b]};
        const auto sides = volumes(around, lattice.kind, t);
        PALPATE_CHECK(sides.size() == 2, "a triangle of a lattice has two sides");
        TrianglePattern pattern;
        pattern.corner = {first, second};
        const auto edges = around.needs({t[0], t[1], t[2]});
        PALPATE_CHECK(edges.size() == 2, "three elements at two masses");
        pattern.edges = {edges[0], edges[1]};
        for (std::size_t s = 0; s < 2; ++s) pattern.side[s] = around.needs_of_volume(sides[s]);
        patterns[static_cast<std::size_t>(kind)].push_back(pattern);
      }
  }
  return patterns;
}

}  // namespace palpate::physics
