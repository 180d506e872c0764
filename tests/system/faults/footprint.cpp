#include "tests/system/faults/footprint.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <sstream>

namespace palpate::test {
namespace {

namespace fs = std::filesystem;
constexpr std::ptrdiff_t looks_compared = 3;  // at either end
constexpr int ports_per_domain = 250, first_port = 7400;

Footprint lowest_of_last(const std::vector<Footprint>& looks) {
  Footprint low = looks.back();
  for (auto look = looks.end() - looks_compared; look != looks.end(); ++look) {
    low.files = std::min(low.files, look->files);
    low.threads = std::min(low.threads, look->threads);
    low.memory_kB = std::min(low.memory_kB, look->memory_kB);
  }
  return low;
}

Footprint middle_of_first(const std::vector<Footprint>& looks) {
  const auto middle = [&](auto Footprint::*of) {
    std::array values = {looks[0].*of, looks[1].*of, looks[2].*of};
    std::ranges::sort(values);
    return values[1];
  };
  Footprint first;
  first.files = middle(&Footprint::files);
  first.threads = middle(&Footprint::threads);
  first.memory_kB = middle(&Footprint::memory_kB);
  return first;
}

bool has_grown(const std::vector<Footprint>& looks) {
  const Footprint first = middle_of_first(looks), last = lowest_of_last(looks);
  return last.files > first.files || last.threads > first.threads;
}

fs::path task_folder(pid_t pid) { return "/proc/" + std::to_string(pid); }

std::string name_of_task(const fs::path& folder) {
  std::string name;
  std::ifstream file(folder / "comm");
  std::getline(file, name);
  return name;
}

const std::array shared_places = {"/dev/shm/", "/tmp/", "/var/tmp/"};

bool is_shared(const std::string& path) {
  return std::any_of(shared_places.begin(), shared_places.end(),
                     [&](const char* place) { return path.starts_with(place); });
}

bool bears_number(const std::string& name, pid_t pid) {
  const std::string number = std::to_string(pid);
  const auto is_word = [&](std::size_t at) {
    return at < name.size() && std::isalnum(static_cast<unsigned char>(name[at])) != 0;
  };
  for (std::size_t at = name.find(number); at != std::string::npos; at = name.find(number, at + 1))
    if (!is_word(at + number.size()) && (at == 0 || !is_word(at - 1))) return true;
  return false;
}

/// UDP ports of this network namespace that somebody holds.
std::vector<int> udp_ports() {
  std::vector<int> ports;
  std::ifstream table("/proc/net/udp");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream words(line);
    std::string slot, local;
    words >> slot >> local;
    ports.push_back(std::stoi(local.substr(local.find(':') + 1), nullptr, 16));
  }
  return ports;
}

}  // namespace

Footprint footprint(pid_t pid) {
  const fs::path proc = task_folder(pid);
  Footprint found;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator(proc / "fd", gone)) {
    ++found.files;
    const std::string target = fs::read_symlink(entry.path(), gone).string();
    if (is_shared(target)) found.shared.insert(target);
  }
  std::ifstream maps(proc / "maps");
  for (std::string line; std::getline(maps, line);)
    if (const std::size_t at = line.find('/'); at != std::string::npos && is_shared(line.substr(at)))
      found.shared.insert(line.substr(at));
  std::ifstream status(proc / "status");
  for (std::string word; status >> word;) {
    if (word == "VmRSS:") status >> found.memory_kB;
    if (word == "Threads:") status >> found.threads;
  }
  return found;
}

bool lies_in(const std::vector<fs::path>& folders, const std::string& path) {
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    const std::string inside = (fs::weakly_canonical(folder) / "").string();
    return fs::weakly_canonical(path).string().starts_with(inside);
  });
}

void Growth::look(pid_t pid) { look(pid, footprint(pid)); }

void Growth::look(pid_t pid, Footprint found) {
  looks_[pid].push_back(std::move(found));
  shared_.merge(looks_[pid].back().shared);
}

Footprint Growth::largest(std::size_t least) const {
  Footprint most;
  for (const auto& [pid, looks] : looks_) {
    if (looks.size() < least) continue;
    const Footprint first = middle_of_first(looks), last = lowest_of_last(looks);
    most.files = std::max(most.files, last.files - first.files);
    most.threads = std::max(most.threads, last.threads - first.threads);
    most.memory_kB = std::max(most.memory_kB, last.memory_kB - first.memory_kB);
  }
  return most;
}

std::string Growth::text(std::size_t least) const {
  std::string lines;
  for (const auto& [pid, looks] : looks_) {
    if (looks.size() < least || !has_grown(looks)) continue;
    lines +=
        fmt::format("process {}, {}, files and threads at every look:", pid, name_of_task(task_folder(pid)));
    for (const Footprint& look : looks) lines += fmt::format(" {}/{}", look.files, look.threads);
    lines += "; threads now:";
    std::error_code gone;
    for (const auto& task : fs::directory_iterator(task_folder(pid) / "task", gone))
      lines += " " + name_of_task(task.path());
    lines += '\n';
  }
  return lines;
}

std::size_t Growth::processes(std::size_t least) const {
  return static_cast<std::size_t>(std::count_if(looks_.begin(), looks_.end(),
                                                [&](const auto& one) { return one.second.size() >= least; }));
}

std::vector<std::string> left_behind(const std::set<std::string>& shared, const std::vector<pid_t>& pids,
                                     int domain) {
  std::vector<std::string> lines;
  for (const auto& path : shared)
    if (fs::exists(path)) lines.push_back(path + " was opened and is left behind");
  for (const char* place : shared_places) {
    std::error_code refused;
    for (const auto& entry : fs::directory_iterator(place, refused))
      for (const pid_t pid : pids)
        if (bears_number(entry.path().filename().string(), pid))
          lines.push_back(entry.path().string() + " is left behind");
  }
  const int first = first_port + ports_per_domain * domain;
  for (const int port : udp_ports())
    if (port >= first && port < first + ports_per_domain)
      lines.push_back(fmt::format("UDP port {} is still held", port));
  for (const pid_t pid : pids)
    if (waitpid(pid, nullptr, WNOHANG) >= 0 || fs::exists("/proc/" + std::to_string(pid) + "/exe"))
      lines.push_back(fmt::format("process {} is still there", pid));
  return lines;
}

}  // namespace palpate::test
