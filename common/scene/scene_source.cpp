#include "common/scene/scene_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error/error.h"
#include "common/math/hash.h"
#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"

namespace palpate {

std::vector<std::string> files_of(const Scene& scene) {
  std::vector<std::string> files = {scene.path};
  for (const BodySpec& body : scene.bodies) {
    if (const auto* mesh = std::get_if<MeshShape>(&body.shape)) files.push_back(mesh->file);
    const auto* volume = std::get_if<VolumeShape>(&body.shape);
    if (volume == nullptr) continue;
    if (volume->slices) files.insert(files.end(), volume->slices->files.begin(), volume->slices->files.end());
    if (!volume->slices) files.push_back(volume->file);
  }
  return files;
}

SceneSource source_of(const Scene& scene, const std::vector<std::string>& settings) {
  SceneSource source{.text = text_of_file(scene.path), .settings = settings, .files = {}};
  if (scene_checksum(source.text, settings) != scene.checksum)
    throw InputError(scene.path + ": has changed while it was being loaded; start again");
  for (const BodySpec& body : scene.bodies) {
    if (const auto* mesh = std::get_if<MeshShape>(&body.shape))
      source.files.push_back({body.name, mesh->file, false});
    const auto* volume = std::get_if<VolumeShape>(&body.shape);
    if (volume == nullptr) continue;
    if (!volume->slices) source.files.push_back({body.name, volume->file, false});
    if (volume->slices)
      for (const auto& file : volume->slices->files) source.files.push_back({body.name, file, true});
  }
  return source;
}

std::vector<std::string> settings_for_files(const SceneSource& source) {
  std::vector<std::string> settings;
  for (std::size_t f = 0; f < source.files.size();) {
    const auto& [body, path, slice] = source.files[f];
    if (!slice) {
      settings.push_back(fmt::format("body.{}.file='{}'", body, path));
      ++f;
      continue;
    }
    std::vector<std::string> quoted;
    for (; f < source.files.size() && source.files[f].body == body; ++f)
      quoted.push_back(fmt::format("'{}'", source.files[f].path));
    settings.push_back(fmt::format("body.{}.files=[{}]", body, fmt::join(quoted, ", ")));
  }
  return settings;
}

}  // namespace palpate
