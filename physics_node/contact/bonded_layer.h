#pragma once
// How much harder a ball of radius R has to press, to the same depth d, where tissue is a layer of thickness h on
// something that stands, over what it would in a half space:
//
//   F / F_Hertz = 1 - 2 a / pi chi + 4 a^2 / pi^2 chi^2 - 8 / pi^3 (a^3 + 4 pi^2 / 15 b) chi^3,   chi = sqrt(R d) / h
//   a = -(1.2876 - 1.4678 nu + 1.3442 nu^2) / (1 - nu),   b = (0.6387 - 1.0277 nu + 1.5164 nu^2) / (1 - nu)
//
// for a layer that cannot slip.
// Source: Dimitriadis et al. 2002, eq. (12), the fourth power left out; to a few percent for chi <= 1.

#include <algorithm>
#include <limits>
#include <numbers>

#include "physics_node/body/body.h"

namespace palpate::physics {

/// @param chi  >= 0; beyond 1 as at 1
inline double bonded_layer(double nu, double chi) noexcept {
  using std::numbers::pi;
  const double x = std::min(chi, 1.0);
  const double a = -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1 - nu);
  const double b = (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1 - nu);
  const double third = -8 / (pi * pi * pi) * (a * a * a + 4 * pi * pi / 15 * b);
  return 1 + x * (-2 * a / pi + x * (4 * a * a / (pi * pi) + x * third));
}

/// From a node at the surface straight down to the first that is held; infinite where there is none [m].
/// @param normal  out of the tissue, unit
/// Cost: the neighbours of a node for each cell of the way.
inline double thickness_below(const Body& body, Index node, const Vec3& normal) noexcept {
  constexpr int most_cells = 100;  // Why: what lies deeper is felt no more
  const Adjacency neighbours = body.adjacency();
  const Vec3 from = body.rest_position(node);
  for (int n = 0; n < most_cells; ++n) {
    const double here = normal.dot(from - body.rest_position(node));
    if (!(body.inverse_mass[static_cast<std::size_t>(node)] > 0)) return here;
    Index next = node;
    double best = 0;
    neighbours.each_neighbour(node, [&](Index other) {
      const Vec3 way = from - body.rest_position(other);
      const double down = normal.dot(way);
      // Of those that lie deeper the one that is least beside the line.
      if (const double value = down - (way - down * normal).norm();
          down > here && (next == node || value > best))
        next = other, best = value;
    });
    if (next == node) break;
    node = next;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace palpate::physics
