#include "physics_node/contact/held_shape.h"

#include "common/error/error.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {

HeldShape held_shape(const ToolSpec& tool) {
  switch (tool.shape) {
    case ToolShape::point:
      return {RigidShape::sphere(tool.radius)};
    case ToolShape::stick:
      // Its axis goes down from the tip: EQUATIONS C-33.
      return {RigidShape::capsule(tool.radius, tool.length + 2 * tool.radius),
              tool.attitude * Vec3(1, -1, -1).asDiagonal(), Vec3(0, 0, tool.radius)};
    case ToolShape::cylinder:
      return {RigidShape::cylinder(tool.radius, tool.length), tool.attitude};
    case ToolShape::cone:
      return {RigidShape::cone(tool.radius, tool.length), tool.attitude};
    case ToolShape::box:
      return {RigidShape::box(0.5 * tool.size), tool.attitude};
    case ToolShape::body:
    case ToolShape::scalpel:
    case ToolShape::scissors:
    case ToolShape::forceps:
    case ToolShape::needle:
      break;
  }
  PALPATE_CHECK(false, "a body has elements of its own, a scalpel an edge, scissors two, forceps jaws");
  return {RigidShape::sphere(tool.radius)};
}

}  // namespace palpate::physics
