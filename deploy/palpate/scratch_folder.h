#pragma once
// A folder for the files of a recorded scene, gone at the end.

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "common/error/error.h"

namespace palpate::deploy {

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "palpate_scene_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw InputError(name + ": no folder can be made there; give another place by the variable TMPDIR");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace palpate::deploy
