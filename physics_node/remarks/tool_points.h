#pragma once
// Points that stand for a tool whose handle is not turned.

#include <vector>

#include "physics_node/remarks/remarks.h"

namespace palpate::physics {

/// About its tip [m]: the tip, points along a stick or an edge, corners, rims and axes of what has flat ends, or the
/// surface of its body.
/// @param apart  of those along a line, at most [m]
std::vector<Vec3> tool_points(const ToolSpec& tool, const Scene& scene, const Bodies& bodies, double apart);

/// Could a body come to a tool, wherever that is?
bool any_flies(const Scene& scene, const Bodies& bodies);

}  // namespace palpate::physics
