#pragma once
// What the cursor points at: where a tool starts that the mouse takes.

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "render_node/model/body_picture.h"
#include "render_node/view/camera.h"

namespace palpate::render {

/// A point just before the nearest surface under a pixel: `before` and half an edge of the body hit, towards the eye, so that a
/// smooth plane through a surface of steps still lies behind it. Nothing: the pixel shows none.
/// @param before  e.g. the radius of a stick [m]
std::optional<Vec3> surface_under(std::span<const BodyPicture> bodies, const Camera& camera,
                                  const Eigen::Vector2d& pixel, double before);

}  // namespace palpate::render
