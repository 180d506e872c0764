#include "common/file/privacy.h"

#include <sys/stat.h>
#include <unistd.h>

namespace palpate {

mode_t withheld(const std::vector<std::string>& inputs) noexcept {
  mode_t mask = 0;
  for (const auto& input : inputs) {
    struct stat facts {};
    if (stat(input.c_str(), &facts) != 0) continue;
    const bool others_read = (facts.st_mode & S_IROTH) != 0;
    const bool group_reads = (facts.st_mode & S_IRGRP) != 0 && (facts.st_gid == getegid() || others_read);
    mask |= others_read ? S_IWOTH & ~facts.st_mode : S_IRWXO;
    mask |= group_reads ? S_IWGRP & ~facts.st_mode : S_IRWXG;
  }
  return mask;
}

void keep_as_private_as(const std::vector<std::string>& inputs) noexcept {
  const mode_t before = umask(S_IRWXG | S_IRWXO);
  umask(before | withheld(inputs));
}

}  // namespace palpate
