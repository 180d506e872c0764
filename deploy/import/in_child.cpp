#include "deploy/import/in_child.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace palpate {
namespace {

std::atomic<pid_t> child{0};

extern "C" void pass_on(int signal) {
  if (child > 0) kill(child, signal);
}

std::atomic<bool> rang{false};

extern "C" void ring(int) { rang = true; }

/// From now on SIGALRM ends a wait instead of the program.
void let_alarms_ring() {
  struct sigaction action = {};
  action.sa_handler = ring;  // without SA_RESTART
  sigaction(SIGALRM, &action, nullptr);
}

}  // namespace

int run_in_child(const std::function<int()>& work, const std::function<void(int)>& waiting,
                 unsigned every_s) {
  std::fflush(nullptr);
  child = fork();
  if (child < 0) return work();  // no room for another process: then without its protection
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int code = work();
    std::fflush(nullptr);
    std::_Exit(code);
  }
  std::signal(SIGINT, pass_on);
  std::signal(SIGTERM, pass_on);
  let_alarms_ring();
  alarm(every_s);
  int status = 0, waited_s = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    if (!rang.exchange(false)) continue;
    waiting(waited_s += static_cast<int>(every_s));
    alarm(every_s);
  }
  alarm(0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace palpate
