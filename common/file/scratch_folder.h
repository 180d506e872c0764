#pragma once
// A folder for files that nobody wants later, below the system's temporary folder; gone with its owner.

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "common/error/error.h"

namespace palpate {

class ScratchFolder {
 public:
  /// @throws InputError: no folder can be made there
  ScratchFolder() {
    std::error_code none;
    const std::filesystem::path place = std::filesystem::temp_directory_path(none);
    std::string name = (place / "palpate_scratch_XXXXXX").string();
    if (none || mkdtemp(name.data()) == nullptr)
      throw InputError((none ? "TMPDIR names no folder" : name + ": no folder can be made there") +
                       "; give another place by the variable TMPDIR");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace palpate
