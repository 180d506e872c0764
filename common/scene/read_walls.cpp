// [[wall]]
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"

namespace palpate {
namespace {

constexpr std::size_t most_walls = 16;

WallSpec read_wall(TableReader& reader) {
  WallSpec wall;
  reader.require("point_mm", "give any point of its surface as [x, y, z]");
  reader.require("normal", "give the direction away from it, to where tissue may be, as [x, y, z]");
  set_if(wall.point, reader.read_vector_mm("point_mm"));
  if (const auto normal = reader.read_direction("normal")) {
    const double length = normal->stableNorm();
    if (length > 0)
      wall.normal = (*normal / length).normalized();
    else
      reader.complain("normal", "\"normal\" in [[wall]] has no length; give a direction such as [0, 0, 1]");
  }
  reader.refuse_left_over();
  return wall;
}

}  // namespace

void read_walls(TableReader& root, ReadContext& context) {
  for (const auto* table : tables_of_list(root, "wall", most_walls)) {
    TableReader reader(*table, "[[wall]]", context.complaints);
    context.scene.walls.push_back(read_wall(reader));
  }
}

}  // namespace palpate
