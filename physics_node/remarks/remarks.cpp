#include "physics_node/remarks/remarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {

Remarks remarks_about(const World& world) {
  const Scene& scene = world.scene();
  Bodies bodies;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) bodies.push_back(&world.body(b));
  const int steps_a_frame = static_cast<int>(std::lround(world.frame_seconds() / world.step_seconds()));
  Remarks all;
  for (Remarks& part : std::array{number_remarks(scene, bodies, steps_a_frame), body_remarks(scene, bodies),
                                  tool_remarks(scene, bodies), picture_remarks(scene, bodies)})
    std::move(part.begin(), part.end(), std::back_inserter(all));
  return all;
}

Eigen::AlignedBox3d box_of(const Body& body) {
  Eigen::AlignedBox3d box;
  for (const Index cell : body.nodes()) box.extend(body.rest_position(cell));
  if (!body.cells) return box;
  const Cells& cells = *body.cells;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i)
        if (cells.is_filled(i, j, k)) box.extend(cells.centre_of(i, j, k));
  return box;
}

bool falls_for_ever(const Scene& scene) {
  if (scene.gravity.isZero()) return false;
  const auto stops = [&](const Vec3& normal) { return normal.dot(scene.gravity) < 0; };
  return !(scene.floor && stops(Vec3::UnitZ())) &&
         std::none_of(scene.walls.begin(), scene.walls.end(),
                      [&](const WallSpec& wall) { return stops(wall.normal); });
}

bool is_tool(const Scene& scene, const Body& body) {
  return std::any_of(scene.tools.begin(), scene.tools.end(), [&](const ToolSpec& tool) {
    return tool.shape == ToolShape::body && tool.body == body.name;
  });
}

}  // namespace palpate::physics
