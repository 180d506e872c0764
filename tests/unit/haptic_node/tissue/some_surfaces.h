#pragma once
// Patches of 8 x 8 nodes, 4 mm apart, whose surface is at z = 0.

#include <cmath>

#include "haptic_node/tissue/tissue_surface.h"

namespace palpate::haptic {

inline constexpr double node_distance = 4e-3;

/// Does not give.
inline SurfaceModel flat_wall(double friction) {
  SurfaceModel m;
  m.sides = {8, 8};
  m.friction = friction;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i)
      m.nodes[static_cast<std::size_t>(i + 8 * j)].rest = Vec3(node_distance * i, node_distance * j, 0);
  return m;
}

/// Two modes whose shapes turn along the surface, and a residual that changes along it.
inline SurfaceModel soft_surface(double friction) {
  SurfaceModel m = flat_wall(friction);
  m.n_modes = 2;
  m.modes[0] = {26'000, 60};
  m.modes[1] = {40'000, 80};
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i) {
      auto& shapes = m.nodes[static_cast<std::size_t>(i + 8 * j)].shapes;
      shapes[0] = Vec3(1 + 0.1 * i, 0.2, 0.5 * std::sin(0.5 * i + 0.3 * j));
      shapes[1] = Vec3(-0.1, 0.8, 1 + 0.4 * std::cos(0.4 * j));
    }
  for (int j = 0; j < 15; ++j)
    for (int i = 0; i < 15; ++i) {
      const double more = 1 + 0.1 * std::sin(0.6 * i) + 0.1 * std::cos(0.5 * j);
      m.residual[static_cast<std::size_t>(i + 15 * j)] = {2e-3 * more, 2e-3 * more, 3e-3 * more,
                                                          1e-4,        2e-4,        -1e-4};
    }
  return m;
}

}  // namespace palpate::haptic
