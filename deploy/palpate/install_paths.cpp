#include "deploy/palpate/install_paths.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace palpate::deploy {

std::filesystem::path bin_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

std::filesystem::path share_folder() { return bin_folder().parent_path() / "share" / "palpate"; }

bool is_program(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

std::filesystem::path program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && is_program(std::filesystem::path(folder) / name))
      return std::filesystem::path(folder) / name;
  return {};
}

}  // namespace palpate::deploy
