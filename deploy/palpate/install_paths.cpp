#include "deploy/palpate/install_paths.h"

#include <unistd.h>

namespace palpate::deploy {

std::filesystem::path bin_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

std::filesystem::path share_folder() { return bin_folder().parent_path() / "share" / "palpate"; }

bool is_program(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

}  // namespace palpate::deploy
