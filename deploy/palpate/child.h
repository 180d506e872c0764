#pragma once
// A child process that cannot be left behind.

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpate::deploy {

/// How a process ended.
struct Ending {
  bool by_signal = false;
  int code = 0;  // exit code, or number of the signal

  bool clean() const { return !by_signal && code == 0; }
  std::string text() const;  // "ended with exit code 3", "was ended by signal 9 (SIGKILL, Killed)"
};

/// Starts a program in a process group of its own (so that Ctrl-C reaches only us), with our stdin, stdout and stderr and
/// no other open file of ours. If we die it gets SIGTERM. One thread may use a Child, the one that made it.
class Child {
 public:
  /// @throws std::runtime_error if no process can be made
  Child(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  ~Child();  // kills and reaps what still runs
  Child(Child&& other) noexcept;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  Child& operator=(Child&&) = delete;

  pid_t pid() const noexcept { return pid_; }
  /// Nothing while it runs. Never waits.
  const std::optional<Ending>& ending() noexcept;
  /// Waits until it ends.
  Ending wait() noexcept;
  void signal(int number) noexcept;  // nothing once it has ended

 private:
  void note(int status) noexcept;

  pid_t pid_ = -1;
  std::optional<Ending> ending_;
};

}  // namespace palpate::deploy
