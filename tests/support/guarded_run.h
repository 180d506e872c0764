#pragma once
// Runs a program as a person would, with an eye on how it ends, how long it takes and how much memory it has.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace palpate::test {

struct Guarded {
  int code = -1;                 // exit code; -1: ended by a signal, ours among them
  bool hung = false;             // it was ended because it took too long
  std::uint64_t peak_bytes = 0;  // most resident memory, of it and of the processes that it waited for
  std::string text;              // stdout and stderr
};

/// Why: whatever ends within 10 s on a quiet machine does within 50 s beside five others; what hangs never
/// does.
inline constexpr std::chrono::seconds patience{50};

/// @param words  program and arguments
/// @param log    a file that is written over
inline Guarded run_guarded(std::vector<std::string> words, const std::string& log) {
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    const int out = open(log.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  Guarded result;
  int status = 0;
  rusage used{};
  const auto start = std::chrono::steady_clock::now();
  while (wait4(child, &status, WNOHANG, &used) == 0) {
    if (!result.hung && std::chrono::steady_clock::now() - start > patience) {
      result.hung = true;
      kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  result.peak_bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
  std::ifstream in(log);
  result.text.assign(std::istreambuf_iterator<char>(in), {});
  return result;
}

}  // namespace palpate::test
