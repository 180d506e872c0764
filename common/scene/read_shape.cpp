// `shape` of a body and the keys that belong to it.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/math/units.h"
#include "common/scene/near_miss.h"
#include "common/scene/read_parts.h"

namespace palpate {
namespace {

const std::vector<std::string> built_shapes = {"sphere", "box", "tube", "volume"};
const std::vector<std::string> later_shapes = {"knife", "needle"};
const std::vector<std::string> keys_of_shapes = {
    "radius_mm", "size_mm",    "outer_radius_mm", "inner_radius_mm", "length_mm",         "axis",
    "file",      "keep",       "partition",       "deformable",      "largest_component", "height_mm",
    "theta_deg", "diameter_mm"};
constexpr int most_cells = 4096;         // along an axis
constexpr int most_nearest = 1'000'000;  // cells

SphereShape read_sphere(TableReader& body) {
  SphereShape sphere;
  body.require("radius_mm", "give the radius of the sphere");
  set_if(sphere.radius, body.read_length_mm("radius_mm"));
  return sphere;
}

BoxShape read_box(TableReader& body) {
  BoxShape box;
  body.require("size_mm", "give the edges of the box as [x, y, z]");
  set_if(box.size, body.read_vector_mm("size_mm", positive));
  return box;
}

TubeShape read_tube(TableReader& body) {
  TubeShape tube;
  body.require("outer_radius_mm", "give the outer radius of the tube");
  body.require("length_mm", "give the length of the tube");
  const auto outer = body.read_length_mm("outer_radius_mm");
  const auto inner = body.read_length_mm("inner_radius_mm", not_negative);
  set_if(tube.outer_radius, outer);
  set_if(tube.inner_radius, inner);
  if (outer && inner && *inner >= *outer)
    body.complain(
        "inner_radius_mm",
        fmt::format("\"inner_radius_mm\" in {} is {:g}; write a number below outer_radius_mm = {:g}",
                    body.title(), mm_from_m(*inner), mm_from_m(*outer)));
  set_if(tube.length, body.read_length_mm("length_mm"));
  if (const auto axis = body.read_word("axis", {"x", "y", "z"})) tube.axis = static_cast<int>(*axis);
  return tube;
}

/// center_voxel = [i, j, k] or center = "gravity".
void read_center(TableReader& reader, DeformableRegion& region) {
  if (const auto center = reader.read_integers("center_voxel", 3, "[i, j, k]", 0, most_cells - 1))
    std::copy(center->begin(), center->end(), region.center_voxel.begin());
  region.gravity_center = reader.read_word("center", {"gravity"}).has_value();
  if (reader.has("center") && reader.has("center_voxel"))
    reader.complain("center", "both \"center\" and \"center_voxel\" are given; keep one of them");
  else if (!reader.has("center") && !reader.has("center_voxel"))
    reader.complain_lack("\"center_voxel\" or \"center\"",
                         "give the middle of the region as [i, j, k], or center = \"gravity\"");
}

/// radius_voxels = n or nearest = n.
void read_extent(TableReader& reader, DeformableRegion& region) {
  if (const auto radius = reader.read_integer("radius_voxels", 1, most_cells))
    region.radius_voxels = static_cast<int>(*radius);
  if (const auto nearest = reader.read_integer("nearest", 1, most_nearest))
    region.nearest = static_cast<int>(*nearest);
  if (reader.has("nearest") && reader.has("radius_voxels"))
    reader.complain("nearest", "both \"radius_voxels\" and \"nearest\" are given; keep one of them");
}

DeformableRegion read_deformable(TableReader& body, ReadContext& context) {
  DeformableRegion region;
  const auto* value = body.find("deformable");
  if (value == nullptr || value->value_or(std::string()) == "all") return region;
  if (!value->is_table()) {
    body.complain_value("deformable", *value,
                        "\"all\" or { center_voxel = [i, j, k] or center = \"gravity\", radius_voxels = n }");
    return region;
  }
  TableReader reader(*value->as_table(), fmt::format("deformable of {}", body.title()), context.complaints);
  region.all = false;
  read_center(reader, region);
  read_extent(reader, region);
  reader.refuse_left_over();
  return region;
}

/// The image file, found from the folder of the scene, or from here where it is given by --set.
void read_volume_file(TableReader& body, const std::string& scene_path, VolumeShape& volume) {
  namespace fs = std::filesystem;
  body.require("file", "name a volume made by \"palpate import\"");
  const auto file = body.read_text("file");
  if (!file) return;
  const bool is_set = place_of(body.find("file")->source()).file.starts_with(setting_prefix);
  const auto folder = is_set ? fs::path() : fs::path(scene_path).parent_path();
  const auto resolved = (folder / *file).lexically_normal();
  volume.file = resolved.string();
  std::error_code error;
  if (!fs::is_regular_file(resolved, error))
    body.complain("file", fmt::format("there is no file {}; make it with \"palpate import IMAGE --out {}\"",
                                      volume.file, volume.file));
}

VolumeShape read_volume_shape(TableReader& body, ReadContext& context) {
  VolumeShape volume;
  read_volume_file(body, context.scene.path, volume);
  body.require("keep", "give the intensities that are tissue as [lowest, highest]");
  if (const auto keep = body.read_numbers("keep", 2, "[lowest, highest]")) {
    volume.keep_min = (*keep)[0];
    volume.keep_max = (*keep)[1];
    if (volume.keep_min > volume.keep_max)
      body.complain("keep", fmt::format("\"keep\" in {} runs from {} down to {}; write [lowest, highest]",
                                        body.title(), volume.keep_min, volume.keep_max));
  }
  if (const auto cells = body.read_integers("partition", 3, "[nx, ny, nz]", 1, most_cells))
    volume.partition = {(*cells)[0], (*cells)[1], (*cells)[2]};
  volume.deformable = read_deformable(body, context);
  set_if(volume.largest_component, body.read_flag("largest_component"));
  return volume;
}

}  // namespace

void read_shape(TableReader& body, ReadContext& context, BodySpec& spec) {
  const auto* value = body.find("shape");
  const auto word = value == nullptr ? std::string() : value->value_or(std::string());
  if (word != "volume" && !body.has("spacing_mm") &&
      std::count(built_shapes.begin(), built_shapes.end(), word) > 0)
    body.complain_lack("\"spacing_mm\"", "give the distance of neighbouring masses");
  if (word == "sphere") {
    spec.shape = read_sphere(body);
  } else if (word == "box") {
    spec.shape = read_box(body);
  } else if (word == "tube") {
    spec.shape = read_tube(body);
  } else if (word == "volume") {
    spec.shape = read_volume_shape(body, context);
  } else {
    body.allow(keys_of_shapes);  // whose they are cannot be told
    if (value == nullptr)
      body.complain_lack("\"shape\"", "write " + quoted_list(built_shapes));
    else if (std::count(later_shapes.begin(), later_shapes.end(), word) > 0)
      body.complain("shape", fmt::format("shape \"{}\" is not built by this version; it builds {}", word,
                                         quoted_list(built_shapes, "and")));
    else
      body.complain_value("shape", *value, quoted_list(built_shapes));
  }
}

}  // namespace palpate
