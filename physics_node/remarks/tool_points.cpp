#include "physics_node/remarks/tool_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/held_shape.h"
#include "physics_node/remarks/enclosure.h"

namespace palpate::physics {
namespace {

constexpr double on_shape = 1e-6;  // of its size: rounding

/// Its corners, circles in its faces, and the lines through its middle.
std::vector<Vec3> points_of_box(const Eigen::AlignedBox3d& box, double apart) {
  constexpr int around = 8;
  std::vector<Vec3> points;
  for (int c = 0; c < 8; ++c) points.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c)));
  const Vec3 middle = box.center(), half = 0.5 * box.sizes();
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const double end : {-1.0, 1.0})
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around;
        Vec3 p = middle;
        p[axis] += end * half[axis];
        p[u] += std::cos(angle) * half[u];
        p[v] += std::sin(angle) * half[v];
        points.push_back(p);
      }
    const int pieces = std::max(1, static_cast<int>(std::ceil(2 * half[axis] / apart)));
    for (int i = 0; i <= pieces; ++i)
      points.push_back(middle + (2.0 * i / pieces - 1) * half[axis] * Vec3::Unit(axis));
  }
  return points;
}

}  // namespace

std::vector<Vec3> tool_points(const ToolSpec& tool, const Scene& scene, const Bodies& bodies, double apart) {
  if (tool.shape == ToolShape::point || tool.shape == ToolShape::forceps || tool.shape == ToolShape::needle)
    return {Vec3::Zero()};
  std::vector<Vec3> points;
  if (tool.shape == ToolShape::scissors) {
    const ScissorsSpec& blades = tool.scissors;
    const double deep = blades.closed_crossing() - blades.open_crossing(), half = 0.5 * blades.mouth();
    const int along = std::max(1, static_cast<int>(std::ceil(deep / apart))),
              across = std::max(1, static_cast<int>(std::ceil(half / apart)));
    for (int z = 0; z <= along; ++z)
      for (int x = -across; x <= across; ++x)
        points.push_back(tool.attitude * Vec3(half * x / across, 0, deep * z / along));
    return points;
  }
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
    for (const Vec3& p : points_of_box(held.shape.bounds(), apart))
      if (held.shape.distance(p).distance <= on_shape * held.shape.size())
        points.push_back(held.attitude * p);
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
