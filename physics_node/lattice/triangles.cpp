#include "physics_node/lattice/triangles.h"

#include <algorithm>
#include <optional>

#include "common/error/error.h"

namespace palpate::physics {
namespace {

/// The neighbourhood of one grid point deep inside a lattice that fills space.
class Surroundings {
 public:
  Surroundings(const Lattice& lattice, const Vec3i& at)
      : lattice_(lattice), at_(at), half_(half_directions(lattice.kind)) {}

  /// The direction of the element from one point to another, both given from `at`, if there is one.
  std::optional<int> element(const Vec3i& from, const Vec3i& to) const {
    const Vec3i delta = to - from;
    const auto n = static_cast<int>(half_.size());
    for (int d = 0; d < 2 * n; ++d) {
      const Vec3i& half = half_[static_cast<std::size_t>(d % n)];
      if (delta != (d < n ? half : Vec3i(-half))) continue;
      // Diagonals of voxels join points of even X + Y + Z.
      const bool exists =
          lattice_.kind == LatticeKind::fcc || delta.cwiseAbs().sum() == 1 || ((at_ + from).sum() & 1) == 0;
      return exists ? std::optional(d) : std::nullopt;
    }
    return std::nullopt;
  }

  std::vector<Vec3i> neighbours(const Vec3i& of) const {
    std::vector<Vec3i> found;
    for (const Vec3i& half : half_)
      for (const Vec3i& delta : {half, Vec3i(-half)})
        if (element(of, of + delta)) found.push_back(of + delta);
    return found;
  }

  Index offset(const Vec3i& delta) const { return lattice_.cell_of(at_ + delta) - lattice_.cell_of(at_); }

  /// What all elements among `points` need, each at the end that comes first: by then it is known to exist.
  std::vector<Need> needs(const std::vector<Vec3i>& points) const {
    std::vector<Need> list;
    for (std::size_t p = 0; p < points.size(); ++p) {
      Need need{offset(points[p]), 0};
      for (std::size_t q = p + 1; q < points.size(); ++q) {
        if (const auto d = element(points[p], points[q])) need.bits |= 1U << *d;
      }
      if (need.bits != 0) list.push_back(need);
    }
    return list;
  }

 private:
  const Lattice& lattice_;
  Vec3i at_;
  std::vector<Vec3i> half_;
};

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
  // Every point of a row kind has the same surroundings; a point far enough from zero stands for all.
  TrianglePatterns patterns;
  const int kinds = lattice.kind == LatticeKind::fcc ? 2 : 4;
  for (int kind = 0; kind < kinds; ++kind) {
    const int parity = kind % 2;
    const Vec3i at = lattice.kind == LatticeKind::fcc ? Vec3i(4 + parity, 4 + parity, 4)
                                                      : Vec3i(4 + kind / 2, 4, 4 + parity);
    const Surroundings around(lattice, at);
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
        for (std::size_t s = 0; s < 2; ++s) pattern.side[s] = around.needs(sides[s]);
        patterns[static_cast<std::size_t>(kind)].push_back(pattern);
      }
  }
  return patterns;
}

}  // namespace palpate::physics
