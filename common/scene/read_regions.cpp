// `regions` of a body: parts of other materials, by a box or a ball in the world or by the intensity of the image.
#include <fmt/format.h>

#include <algorithm>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/near_miss.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"

namespace palpate {
namespace {

constexpr std::size_t most_regions = 64;
constexpr std::int64_t most_group = 2147483647;  // Why: what the mesh reader takes
constexpr std::string_view region_form =
    "{ material = \"NAME\" } with box_min_mm and box_max_mm, center_mm and radius_mm, intensity or group";

void read_intensity(TableReader& reader, bool is_volume, RegionSpec& region) {
  IntensityRegion window;
  if (!is_volume)
    reader.complain("intensity",
                    "\"intensity\" needs an image, and this body's shape is neither \"volume\" nor "
                    "\"slices\"; give a box or a ball instead");
  if (const auto ends = reader.read_numbers("intensity", 2, "[lowest, highest]")) {
    window = {(*ends)[0], (*ends)[1]};
    if (window.lo > window.hi)
      reader.complain("intensity",
                      fmt::format("\"intensity\" in {} runs from {} down to {}; write [lowest, highest]",
                                  reader.title(), window.lo, window.hi));
  }
  region.where = window;
}

void read_group(TableReader& reader, bool is_mesh, RegionSpec& region) {
  GroupRegion of_group;
  if (!is_mesh)
    reader.complain(
        "group",
        "\"group\" is of a mesh, and this body's shape is not \"mesh\"; give a box or a ball instead");
  if (const auto group = reader.read_integer("group", -most_group, most_group))
    of_group.group = static_cast<int>(*group);
  region.where = of_group;
}

/// Exactly one way to say where.
void read_where(TableReader& reader, const Shape& shape, RegionSpec& region) {
  const bool box = reader.has("box_min_mm") || reader.has("box_max_mm");
  const bool ball = reader.has("center_mm") || reader.has("radius_mm");
  const bool intensity = reader.has("intensity");
  const bool group = reader.has("group");
  const int ways =
      static_cast<int>(box) + static_cast<int>(ball) + static_cast<int>(intensity) + static_cast<int>(group);
  constexpr std::string_view advice =
      "give box_min_mm and box_max_mm, or center_mm and radius_mm, or intensity = [lowest, highest], or "
      "group = "
      "a number of the mesh file";
  if (ways == 0) reader.complain_lack("a place", advice);
  if (ways > 1)
    reader.complain_at(reader.place(), fmt::format("{} has {} places; {}", reader.title(), ways, advice));
  if (box) region.where = read_box_place(reader);
  if (ball) region.where = read_ball_place(reader);
  if (intensity) read_intensity(reader, std::holds_alternative<VolumeShape>(shape), region);
  if (group) read_group(reader, std::holds_alternative<MeshShape>(shape), region);
  reader.allow({"box_min_mm", "box_max_mm", "center_mm", "radius_mm", "intensity", "group"});
}

bool has_damper(const MaterialSpec& material) {
  return material.viscosity.value_or(0) > 0 || material.viscosity_bulk.value_or(0) > 0;
}

/// The dampers of one body are of one kind: the law between two materials is a mean of two alike.
void refuse_other_damper(TableReader& reader, const ReadContext& context, const BodySpec& spec,
                         const std::string& name) {
  const auto find = [&](const std::string& wanted) -> const MaterialSpec* {
    const auto& all = context.scene.materials;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const MaterialSpec& m) { return m.name == wanted; });
    return found != all.end() && has_damper(*found) ? &*found : nullptr;
  };
  const auto* mine = find(name);
  if (mine == nullptr) return;
  std::vector<std::string> others = {spec.material};
  for (const auto& region : spec.regions) others.push_back(region.material);
  for (const auto& other : others) {
    const auto* theirs = find(other);
    if (theirs == nullptr || theirs->damper == mine->damper) continue;
    reader.complain("material",
                    fmt::format("materials \"{}\" and \"{}\" of one body have different dampers; give both "
                                "the same damper",
                                other, name));
    return;
  }
}

void read_region(const toml::table& table, TableReader& body, ReadContext& context, BodySpec& spec) {
  TableReader reader(table, fmt::format("regions of {}", body.title()), context.complaints);
  RegionSpec region;
  region.place = reader.place();
  reader.require("material", "name a [material.NAME] of this scene");
  read_where(reader, spec.shape, region);
  if (const auto material = reader.read_text("material")) {
    region.material = *material;
    refuse_unknown_reference(reader, "material", *material, names_of(context.scene.materials));
    refuse_other_damper(reader, context, spec, *material);
  }
  reader.refuse_left_over();
  spec.regions.push_back(std::move(region));
}

}  // namespace

void read_regions(TableReader& body, ReadContext& context, BodySpec& spec) {
  const auto* list = body.read_array("regions", fmt::format("a list of {}", region_form));
  if (list == nullptr) return;
  if (list->size() > most_regions) {
    body.complain("regions",
                  fmt::format("{} regions in {}; at most {}", list->size(), body.title(), most_regions));
    return;
  }
  for (const auto& item : *list) {
    if (item.is_table())
      read_region(*item.as_table(), body, context, spec);
    else
      body.complain_value("regions", item, region_form);
  }
}

}  // namespace palpate
