#pragma once
// The strict reader of scene files. Keys carry units, unknown keys are errors, and every mistake in the file is
// reported in one go, each as "file:line:column: what; what would be right".

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/scene.h"

namespace palpate {

/// Reads a scene.
/// @param path      of the TOML file
/// @param settings  "table.key=value" as given by --set, applied over the file before it is checked. Elements of
///                  [[body]] and [[tool]] are reached by name ("body.head.at_mm=[0,0,0]"), the rest by key
///                  ("physics.threads=2", "material.skin.modulus_kPa=20"). The value is TOML; a bare word is a string.
/// @throws InputError with one complaint per mistake
Scene load_scene(const std::string& path, const std::vector<std::string>& settings = {});

/// The same from text; `path` only names the file in messages.
Scene parse_scene(std::string_view text, const std::string& path,
                  const std::vector<std::string>& settings = {});

/// The text of a scene file. @throws InputError: none there, too large, cannot be read
std::string text_of_file(const std::string& path);

/// Scene::checksum.
std::uint64_t scene_checksum(std::string_view text, const std::vector<std::string>& settings);

}  // namespace palpate
