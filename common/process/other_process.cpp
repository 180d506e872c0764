#include "common/process/other_process.h"

#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>

namespace palpate {
namespace {

struct Stat {
  char state = 0;             // R, S, D, T, Z, X, ...
  std::uint64_t started = 0;  // after the machine was [ticks of 10 ms]
};

/// /proc/PID/stat: its name may hold anything, so that fields count from the last bracket on.
std::optional<Stat> stat_of(std::uint32_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return {};
  const auto bracket = line.rfind(')');
  if (bracket == std::string::npos) return {};
  constexpr int between = 18;  // fields 4 to 21
  Stat stat;
  std::istringstream fields(line.substr(bracket + 1));
  std::string skipped;
  fields >> stat.state;
  for (int i = 0; i < between; ++i) fields >> skipped;
  if (!(fields >> stat.started)) return {};
  return stat;
}

}  // namespace

bool has_ended(std::uint32_t pid) {
  const auto stat = stat_of(pid);
  return !stat || stat->state == 'Z' || stat->state == 'X';
}

bool started_before(std::uint32_t pid, std::uint32_t other) {
  const auto a = stat_of(pid), b = stat_of(other);
  return a && b && std::tie(a->started, pid) < std::tie(b->started, other);
}

}  // namespace palpate
