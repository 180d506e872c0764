#pragma once
// What processes hold while they run, and what they leave behind when they have gone.

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace palpate::test {

struct Footprint {
  int files = 0;  // open descriptors
  int threads = 0;
  long memory_kB = 0;  // resident
  std::set<std::string>
      shared;  // files open or mapped in places that outlive a process: /dev/shm, /tmp, /var/tmp
};
Footprint footprint(pid_t pid);

/// Whether a path lies in one of these folders. The clone and its build may lie under /tmp: what nodes open there is theirs to
/// read, and no leftover.
bool lies_in(const std::vector<std::filesystem::path>& folders, const std::string& path);

/// Whether a process that goes on living grows while others come and go. It is looked at when all is calm.
class Growth {
 public:
  void look(pid_t pid);
  void look(pid_t pid, Footprint found);
  /// Lowest of the last three looks less the middle of the first three, per process with at least `least` looks: neither a
  /// moment's open file or thread nor one that a starting process had not yet made shows.
  Footprint largest(std::size_t least = 8) const;
  std::size_t processes(std::size_t least = 8) const;
  /// The same in words: a line for each process that lives and has more files or threads, with its program, every look and
  /// the names of its threads now. (Names are read here alone: to list a process's threads at every look keeps the kernel
  /// busy for seconds when that process ends.)
  std::string text(std::size_t least = 8) const;
  const std::set<std::string>& shared() const { return shared_; }

 private:
  std::map<pid_t, std::vector<Footprint>> looks_;
  std::set<std::string> shared_;
};

/// After all have gone: which of those files are still there, files in the shared places that bear a process's number,
/// sockets of the DDS domain, and processes, zombies too. One line each.
std::vector<std::string> left_behind(const std::set<std::string>& shared, const std::vector<pid_t>& pids,
                                     int domain);

}  // namespace palpate::test
