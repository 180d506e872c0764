#pragma once
// Which lines between a mass and the facets round it are lines of contact.

#include <cstddef>
#include <span>

namespace palpate::physics {

/// Is another facet of the same surface nearer to the mass, with the nearest point of this one in it? Then that point is nearest to the mass
/// among those of this facet only: the surface goes on beyond the edge, and comes nearer. What remains are the local minima of the
/// distance, one on whatever is flat or convex, one for each side of a groove. Facets are convex, so that the test is exact.
/// Why: a push along such a line is oblique to a plane, and pushes sideways what lies on it without friction. It takes whatever begins beside
/// the corners of a mesh farther from them.
/// Source: Ericson, Real-Time Collision Detection, 3.9 (Voronoi regions of features).
/// @tparam Row  end: the mass and three corners (body, n); weight of the corners in the nearest point; distance [m]
/// @param rows  those of a mass with the facets of a body stand together, in any order
template <class Row>
bool is_shadowed(std::span<const Row> rows, std::size_t n) noexcept {
  // Why: rounding makes the distances of two facets from their common edge differ by 1e-16 of them.
  constexpr double nearer = 1 - 1e-9;
  const Row& row = rows[n];
  const auto holds_point = [&](const Row& other) {
    for (int k = 0; k < 3; ++k) {
      const auto corner = row.end[static_cast<std::size_t>(k) + 1].n;
      if (row.weight[k] > 0 && corner != other.end[1].n && corner != other.end[2].n &&
          corner != other.end[3].n)
        return false;
    }
    return true;
  };
  const auto of_one_surface = [&](const Row& other) {
    return other.end[0].n == row.end[0].n && other.end[0].body == row.end[0].body &&
           other.end[1].body == row.end[1].body;
  };
  const auto shadows = [&](const Row& other) {
    return other.distance < nearer * row.distance && holds_point(other);
  };
  if (row.weight[0] > 0 && row.weight[1] > 0 && row.weight[2] > 0) return false;  // inside the facet
  for (std::size_t k = n; k-- > 0 && of_one_surface(rows[k]);)
    if (shadows(rows[k])) return true;
  for (std::size_t k = n + 1; k < rows.size() && of_one_surface(rows[k]); ++k)
    if (shadows(rows[k])) return true;
  return false;
}

}  // namespace palpate::physics
