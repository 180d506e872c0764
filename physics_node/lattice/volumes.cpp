#include "physics_node/lattice/volumes.h"

#include <algorithm>
#include <tuple>

namespace palpate::physics {
namespace {

/// @param corners  in storage order, the first at zero
VolumePattern pattern_of(const Surroundings& around, const std::vector<Vec3i>& corners) {
  VolumePattern pattern;
  for (const Vec3i& corner : corners) {
    pattern.corner.push_back(around.offset(corner));
    pattern.lowest = pattern.lowest.cwiseMin(corner);
  }
  pattern.needs = around.needs_of_volume(corners);
  return pattern;
}

/// Four masses that all neighbour each other.
void add_tetrahedra(const Surroundings& around, std::vector<VolumePattern>& patterns) {
  std::vector<Vec3i> near;
  for (const Vec3i& delta : around.neighbours(Vec3i::Zero()))
    if (around.offset(delta) > 0) near.push_back(delta);
  std::sort(near.begin(), near.end(),
            [&](const Vec3i& a, const Vec3i& b) { return around.offset(a) < around.offset(b); });
  for (std::size_t a = 0; a < near.size(); ++a)
    for (std::size_t b = a + 1; b < near.size(); ++b)
      for (std::size_t c = b + 1; c < near.size(); ++c) {
        if (!around.element(near[a], near[b]) || !around.element(near[b], near[c]) ||
            !around.element(near[a], near[c]))
          continue;
        patterns.push_back(pattern_of(around, {Vec3i::Zero(), near[a], near[b], near[c]}));
        patterns.back().tetrahedra = {{0, 1, 2, 3}};
      }
}

/// The six places one step from an octahedral site, those across from each other beside each other.
const std::array<Vec3i, 6> round_a_site{Vec3i(0, 0, -1), Vec3i(0, 0, 1),  Vec3i(0, -1, 0),
                                        Vec3i(0, 1, 0),  Vec3i(-1, 0, 0), Vec3i(1, 0, 0)};

/// Octahedra of the fcc lattice; @param missing  of round_a_site: half of one without this mass; 6: a whole one
void add_octahedron(const Surroundings& around, std::size_t missing, std::vector<VolumePattern>& patterns) {
  std::vector<std::size_t> present;
  for (std::size_t n = 0; n < 6; ++n)
    if (n != missing) present.push_back(n);
  // Storage order is that of z, then y, then x, wherever the site is.
  std::sort(present.begin(), present.end(), [](std::size_t n, std::size_t m) {
    const Vec3i &a = round_a_site[n], &b = round_a_site[m];
    return std::tuple(a.z(), a.y(), a.x()) < std::tuple(b.z(), b.y(), b.x());
  });
  const Vec3i first = round_a_site[present.front()];
  std::vector<Vec3i> corners;
  for (const std::size_t n : present) corners.push_back(round_a_site[n] - first);
  VolumePattern pattern = pattern_of(around, corners);
  const auto number = [&](std::size_t n) {
    return static_cast<std::uint8_t>(std::find(present.begin(), present.end(), n) - present.begin());
  };
  // Round the axis that is whole (bottom and top), or that the missing mass leaves one end of.
  const std::size_t axis = missing < 6 ? missing / 2 : 0;
  const std::size_t b = 2 * ((axis + 1) % 3), c = 2 * ((axis + 2) % 3);
  const std::array<std::uint8_t, 4> ring{number(b), number(c), number(b + 1), number(c + 1)};
  if (missing < 6) {
    const std::uint8_t apex = number(missing ^ 1U);
    pattern.tetrahedra = {{apex, ring[0], ring[1], ring[2]}, {apex, ring[0], ring[2], ring[3]}};
    pattern.lacks = round_a_site[missing] - first;
  } else {
    for (std::size_t n = 0; n < 4; ++n)
      pattern.tetrahedra.push_back({number(0), number(1), ring[n], ring[(n + 1) % 4]});
  }
  patterns.push_back(std::move(pattern));
}

}  // namespace

VolumePatterns volume_patterns(const Lattice& lattice) {
  VolumePatterns patterns;
  for (int kind = 0; kind < Surroundings::kinds(lattice); ++kind) {
    const Surroundings around(lattice, kind);
    auto& of_kind = patterns[static_cast<std::size_t>(kind)];
    add_tetrahedra(around, of_kind);
    if (lattice.kind != LatticeKind::fcc) continue;
    for (std::size_t missing = 0; missing <= 6; ++missing) add_octahedron(around, missing, of_kind);
  }
  return patterns;
}

}  // namespace palpate::physics
