// Shapes that come from images: "volume" and "slices".
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/math/units.h"
#include "common/scene/file_list.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"
#include "common/scene/shape_spec.h"

namespace palpate {
namespace {

constexpr int most_cells = 4096;         // along an axis
constexpr int most_nearest = 1'000'000;  // cells
constexpr std::size_t most_slices = 4096;

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
                        "\"all\", { awake_mm = r } or { center_voxel = [i, j, k] or center = \"gravity\", "
                        "radius_voxels = n }");
    return region;
  }
  TableReader reader(*value->as_table(), fmt::format("deformable of {}", body.title()), context.complaints);
  region.awake = reader.read_length_mm("awake_mm");
  if (reader.has("awake_mm")) {
    for (const char* key : {"center_voxel", "center", "radius_voxels", "nearest"}) {
      reader.allow({key});
      if (reader.has(key))
        reader.complain(key,
                        fmt::format("\"{}\" beside \"awake_mm\", with which all cells move; leave one of "
                                    "them out",
                                    key));
    }
  } else {
    region.all = false;
    read_center(reader, region);
    read_extent(reader, region);
  }
  reader.refuse_left_over();
  return region;
}

void read_volume_file(TableReader& body, const std::string& scene_path, VolumeShape& volume) {
  body.require("file", "name a volume made by \"palpate import\"");
  const auto file = body.read_text("file");
  if (!file) return;
  volume.file = path_of(body, "file", scene_path, *file);
  std::error_code error;
  if (!std::filesystem::is_regular_file(volume.file, error))
    body.complain("file", fmt::format("there is no file {}; make it with \"palpate import IMAGE --out {}\"",
                                      volume.file, volume.file));
}

/// files = "slice_*.png" or a list of files, in order.
std::vector<std::string> read_files(TableReader& body, const std::string& scene_path) {
  constexpr std::string_view form = "a pattern like \"brain/slice_*.png\" or a list of PNG files";
  const auto* value = body.find("files");
  if (value == nullptr) return {};
  std::vector<std::string> patterns, files;
  if (const auto* text = value->as_string()) patterns.push_back(text->get());
  if (const auto* list = value->as_array())
    for (const auto& item : *list) patterns.push_back(item.value_or(std::string()));
  if (patterns.empty() || std::count(patterns.begin(), patterns.end(), std::string()) > 0) {
    body.complain_value("files", *value, form);
    return {};
  }
  for (const auto& pattern : patterns) {
    const std::filesystem::path path = path_of(body, "files", scene_path, pattern);
    const auto found = files_of_pattern(path);
    if (found.empty())
      body.complain("files", fmt::format("there is no file {}; give {}", path.string(), form));
    files.insert(files.end(), found.begin(), found.end());
  }
  if (files.size() > most_slices)
    body.complain("files",
                  fmt::format("{} slices in {}; at most {}", files.size(), body.title(), most_slices));
  return files;
}

SliceStack read_slice_stack(TableReader& body, const std::string& scene_path) {
  SliceStack slices;
  body.require("files", "name the pictures of the planes, the lowest first, as \"brain/slice_*.png\"");
  slices.files = read_files(body, scene_path);
  body.require("pixel_mm", "give the distance of pixels as [dx, dy]");
  if (const auto pixel = body.read_numbers("pixel_mm", 2, "[dx, dy]", positive)) {
    slices.spacing.x() = m_from_mm((*pixel)[0]);
    slices.spacing.y() = m_from_mm((*pixel)[1]);
  }
  body.require("plane_mm", "give the distance of the planes");
  set_if(slices.spacing.z(), body.read_length_mm("plane_mm"));
  return slices;
}

/// What files of both kinds have in common.
void read_tissue(TableReader& body, ReadContext& context, VolumeShape& volume) {
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
}

}  // namespace

std::string path_of(TableReader& body, std::string_view key, const std::string& scene_path,
                    const std::string& file) {
  namespace fs = std::filesystem;
  const bool is_set = place_of(body.find(key)->source()).file.starts_with(setting_prefix);
  const auto folder = is_set ? fs::path() : fs::path(scene_path).parent_path();
  return (folder / file).lexically_normal().string();
}

VolumeShape read_volume_shape(TableReader& body, ReadContext& context) {
  VolumeShape volume;
  read_volume_file(body, context.scene.path, volume);
  read_tissue(body, context, volume);
  return volume;
}

VolumeShape read_slices_shape(TableReader& body, ReadContext& context) {
  VolumeShape volume;
  volume.slices = read_slice_stack(body, context.scene.path);
  read_tissue(body, context, volume);
  return volume;
}

}  // namespace palpate
