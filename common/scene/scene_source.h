#pragma once
// What a scene was read from, to keep it with what came of it: its text, the settings over it, the files that it names.

#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"

namespace palpate {

struct SceneSource {
  struct File {
    std::string body;  // that is made of it
    std::string path;
    bool slice = false;  // one picture of a stack
  };
  std::string text;
  std::vector<std::string> settings;  // table.key=value, in order
  std::vector<File> files;            // images; of a stack of slices in order
};

/// The scene file and the images it names, as far as paths go.
std::vector<std::string> files_of(const Scene& scene);

/// @param settings  those that the scene was loaded with
/// @throws InputError if the file has changed since
SceneSource source_of(const Scene& scene, const std::vector<std::string>& settings);

/// The settings under which the files of a scene are found elsewhere: one for each body that is made of files.
/// @param source  files: where they are now
std::vector<std::string> settings_for_files(const SceneSource& source);

}  // namespace palpate
