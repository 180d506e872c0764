#include "physics_node/remarks/tool_points.h"

#include <algorithm>
#include <cmath>

#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/held_shape.h"
#include "physics_node/remarks/enclosure.h"

namespace palpate::physics {

std::vector<Vec3> tool_points(const ToolSpec& tool, const Scene& scene, const Bodies& bodies, double apart) {
  if (tool.shape == ToolShape::point || tool.shape == ToolShape::forceps || tool.shape == ToolShape::needle)
    return {Vec3::Zero()};
  std::vector<Vec3> points;
  if (tool.shape == ToolShape::stick || tool.shape == ToolShape::scalpel) {
    const Vec3 axis =
        tool.attitude * (tool.shape == ToolShape::stick ? Vec3(-Vec3::UnitZ())
                                                        : Vec3(-std::sin(tool.edge), 0, std::cos(tool.edge)));
    for (double s = 0; s < tool.length; s += apart) points.push_back(s * axis);
    points.push_back(tool.length * axis);
    return points;
  }
  if (is_solid_tip(tool.shape)) {
    const HeldShape held = held_shape(tool);
    const Eigen::AlignedBox3d box = held.shape.bounds();
    for (int c = 0; c < 8; ++c)
      points.push_back(held.attitude * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c)));
    return points;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (scene.bodies[b].name != tool.body) continue;
    const Enclosure own(*bodies[b]);
    for (const Vec3& vertex : own.vertices()) points.push_back(vertex - bodies[b]->body().tip);
  }
  return points;
}

bool any_flies(const Scene& scene, const Bodies& bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) {
    return !is_tool(scene, body->body()) && !is_anchored(body->body()) &&
           (!scene.gravity.isZero() || !body->body().velocity.isZero());
  });
}

}  // namespace palpate::physics
