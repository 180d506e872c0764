#include "bench/team/crowd.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace palpate::bench {
namespace {

/// Until it is killed, or its maker is gone. Only calls that are safe after a fork beside threads.
[[noreturn]] void work(pid_t maker) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (volatile unsigned n = 0; getppid() == maker;)
    for (int turn = 0; turn < 1'000'000; ++turn) n = n * 1664525U + 1013904223U;
  _exit(0);
}

}  // namespace

Crowd::Crowd(int processes) {
  const pid_t maker = getpid();
  for (int n = 0; n < processes; ++n) {
    const pid_t pid = fork();
    if (pid == 0) work(maker);
    if (pid < 0) {
      end();
      throw std::runtime_error("no process can be made");
    }
    pids_.push_back(pid);
  }
}

void Crowd::end() noexcept {
  for (const pid_t pid : pids_) {
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
  }
  pids_.clear();
}

Crowd::~Crowd() { end(); }

}  // namespace palpate::bench
