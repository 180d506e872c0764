#include "common/file/privacy.h"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

namespace palpate {
namespace {

namespace fs = std::filesystem;

/// Who cannot come through a folder reaches nothing in it, whatever the rights of the file.
mode_t shut_out_above(const std::string& input) {
  mode_t mask = 0;
  std::error_code unknown;
  const fs::path real = fs::canonical(input, unknown);
  if (unknown) return mask;
  for (fs::path folder = real.parent_path();; folder = folder.parent_path()) {
    struct stat facts {};
    if (stat(folder.c_str(), &facts) == 0) {
      const mode_t for_our_group = facts.st_gid == getegid() ? S_IXGRP : S_IXOTH;
      if ((facts.st_mode & S_IXOTH) == 0) mask |= S_IRWXO;
      if ((facts.st_mode & for_our_group) == 0) mask |= S_IRWXG;
    }
    if (folder == folder.parent_path()) return mask;
  }
}

}  // namespace

mode_t withheld(const std::vector<std::string>& inputs) {
  mode_t mask = 0;
  for (const auto& input : inputs) {
    struct stat facts {};
    if (stat(input.c_str(), &facts) != 0) continue;
    const bool others_read = (facts.st_mode & S_IROTH) != 0;
    const bool group_reads = (facts.st_mode & S_IRGRP) != 0 && (facts.st_gid == getegid() || others_read);
    mask |= others_read ? S_IWOTH & ~facts.st_mode : S_IRWXO;
    mask |= group_reads ? S_IWGRP & ~facts.st_mode : S_IRWXG;
    mask |= shut_out_above(input);
  }
  return mask;
}

void keep_as_private_as(const std::vector<std::string>& inputs) {
  const mode_t before = umask(S_IRWXG | S_IRWXO);
  umask(before | withheld(inputs));
}

}  // namespace palpate
