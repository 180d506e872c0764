#pragma once
// Where a tip can come to the surface of tissue from outside, and press it: tissue of two cells and more in depth.

#include <optional>

#include "physics_node/body/cells.h"

namespace palpate::deploy {

using physics::Vec3i;

struct TouchPlace {
  Vec3 at = Vec3::Zero();        // on a face of a filled cell [m]
  Vec3 outward = Vec3::UnitZ();  // mean normal of the faces within two radii, unit
  double thickness = 0;  // of the tissue behind, along -outward; at most most_looked_through(radius) [m]
  Vec3i cell = Vec3i::Zero();  // filled, behind the face
};

/// How far outside a path begins: a ball has room there and all the way in, and nothing more lies further out [m].
constexpr double approach_length(double tip_radius) { return 3 * tip_radius; }
/// How far in tissue is looked through [m].
constexpr double most_looked_through(double tip_radius) { return 4 * tip_radius; }

/// The best of what is first met along the six axes of the image: thick tissue behind, even, near the middle of the
/// image. Sides where the tissue reaches the end of the image, and was cut there, do not count. Nothing: no tip can
/// come to any.
std::optional<TouchPlace> best_place(const physics::Cells& cells, double tip_radius);

/// The nearest to p that a tip can come to, of the nearest 20,000 faces.
std::optional<TouchPlace> place_near(const physics::Cells& cells, const Vec3& p, double tip_radius);

}  // namespace palpate::deploy
