#pragma once
// When and where the path that a scene writes down first meets a body: from geometry alone, bodies at rest and the
// handle as at the start.

#include <optional>

#include "physics_node/remarks/remarks.h"

namespace palpate::physics {

struct FirstTouch {
  double t = 0;            // [s]
  Vec3 at = Vec3::Zero();  // on the surface, world [m]
  std::size_t body = 0;    // of the scene
};

/// Can it be known? Not of a driver that no path leads, of a handle that turns, or where bodies move by themselves.
bool may_know_first_touch(const Scene& scene, const Bodies& bodies, const ToolSpec& tool);

/// The tip of a point: out of contact its ball lies outside, on the side away from the tissue, so the tip comes
/// first. Of tools with a shape, whichever is first: one of their own points (tool_points.h) at a facet, or a vertex
/// of a surface inside of a rigid shape, to a quarter of a cell. What is between these, such as an edge across an
/// edge, is not seen. Rigid scenery counts, bodies that are tools do not.
/// @return nothing: it never does
/// Cost: the surfaces of all bodies, then what is near the path.
std::optional<FirstTouch> first_touch(const Scene& scene, const Bodies& bodies, const ToolSpec& tool);

}  // namespace palpate::physics
