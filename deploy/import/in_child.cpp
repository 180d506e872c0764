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

}  // namespace

int run_in_child(const std::function<int()>& work) {
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
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace palpate
