#include "common/process/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace palpate {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// The number in a file; unlimited where it says so ("max") or there is none.
std::uint64_t limit_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::uint64_t bytes = 0;
  return in >> bytes ? bytes : unlimited;
}

/// The least limit along the way up from our control group. Source: Linux,
/// Documentation/admin-guide/cgroup-v2.rst
std::uint64_t group_limit() {
  namespace fs = std::filesystem;
  std::uint64_t least = std::min(limit_in("/sys/fs/cgroup/memory.max"),
                                 limit_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"));  // version 1
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::/")) continue;
    for (fs::path group = line.substr(4); !group.empty(); group = group.parent_path())
      least = std::min(least, limit_in("/sys/fs/cgroup" / group / "memory.max"));
  }
  return least;
}

}  // namespace

std::uint64_t machine_memory() noexcept {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  const std::uint64_t machine = pages > 0 && page > 0
                                    ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page)
                                    : unlimited;
  try {
    return std::min(machine, group_limit());
  } catch (...) {
    return machine;
  }
}

}  // namespace palpate
