#pragma once
// A room of its own for shared memory: /dev/shm, /tmp and the loopback interface of this process and its children are
// nobody else's, so that a RouDi of the test is seen by the test alone, and what is left behind is seen by the test.

#include <fcntl.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/system/patience.h"

namespace palpate::test {

inline bool write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  return static_cast<bool>(file << text << std::flush);
}

inline bool raise_loopback() {
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  ifreq request = {};
  std::strncpy(request.ifr_name, "lo", IFNAMSIZ);
  request.ifr_flags = IFF_UP | IFF_RUNNING;
  const bool up = ioctl(descriptor, SIOCSIFFLAGS, &request) == 0;
  close(descriptor);
  return up;
}

/// Shows a folder again that a file system of our own would hide.
/// @param before  the folder, opened before it was hidden
inline bool show_again(const std::filesystem::path& folder, int before) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string from = "/proc/self/fd/" + std::to_string(before);
  return !error && mount(from.c_str(), folder.c_str(), nullptr, MS_BIND | MS_REC, nullptr) == 0 &&
         chdir(folder.c_str()) == 0;
}

/// Moves this process, which must have one thread, into the room. The current folder, where the programs are and the results
/// go, may itself lie below /tmp: it stays in sight. @return why that is not possible; empty: it is there
inline std::string enter_memory_room() {
  const auto here = std::filesystem::current_path();
  const auto user = std::to_string(geteuid()), group = std::to_string(getegid());
  if (geteuid() == 0) {
    if (unshare(CLONE_NEWNS | CLONE_NEWNET) != 0) return "no namespaces here";
  } else {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWNET) != 0) return "no namespaces for users here";
    write_file("/proc/self/setgroups", "deny");
    write_file("/proc/self/uid_map", "0 " + user + " 1");
    write_file("/proc/self/gid_map", "0 " + group + " 1");
  }
  if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return "no mounts of our own here";
  const int before =
      open(here.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);  // of this room, or it cannot be mounted
  if (mount("room", "/dev/shm", "tmpfs", 0, nullptr) != 0 || mount("room", "/tmp", "tmpfs", 0, nullptr) != 0)
    return "no file systems of our own here";
  if (here.string().starts_with("/tmp/") && !show_again(here, before)) return "no folder below /tmp here";
  close(before);
  return raise_loopback() ? "" : "no loopback interface of our own here";
}

/// Bytes that the loopback interface of the room has carried.
inline std::uint64_t loopback_bytes() {
  std::ifstream table("/proc/net/dev");
  for (std::string line; std::getline(table, line);) {
    const auto at = line.find("lo:");
    if (at == std::string::npos) continue;
    std::uint64_t received = 0;
    std::istringstream(line.substr(at + 3)) >> received;
    return received;
  }
  return 0;
}

inline std::set<std::string> shared_files() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
    names.insert(entry.path().filename().string());
  return names;
}

/// A child process with its output in a file.
class Process {
 public:
  explicit Process(std::vector<std::string> words, std::string output) : output_(std::move(output)) {
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::filesystem::remove(output_);  // what an earlier one said
    pid_ = fork();
    if (pid_ != 0) return;
    if (std::freopen(output_.c_str(), "w", stdout) == nullptr) _exit(126);
    dup2(STDOUT_FILENO, STDERR_FILENO);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  ~Process() {
    if (pid_ <= 0) return;
    tell(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void tell(int signal) const { kill(pid_, signal); }
  /// Exit code; minus the signal that ended it; -1000 if it does not end while there is patience.
  int wait() {
    const auto end = std::chrono::steady_clock::now() + patience;
    int status = 0;
    while (waitpid(pid_, &status, WNOHANG) != pid_) {
      if (std::chrono::steady_clock::now() > end) return -1000;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  std::string text() const {
    std::ifstream file(output_);
    std::stringstream all;
    all << file.rdbuf();
    return all.str();
  }
  /// Waits until its output has a place like `form`. @return false if that takes too long
  bool said(const std::string& form) const {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!std::regex_search(text(), std::regex(form))) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }

 private:
  std::string output_;
  pid_t pid_ = -1;
};

}  // namespace palpate::test
