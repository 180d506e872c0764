#include "common/process/stop_flag.h"

#include <atomic>
#include <csignal>
#include <fstream>

namespace palpate {
namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

std::atomic<int> sender{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void on_signal(int, siginfo_t* info, void*) {
  sender.store(info->si_code == SI_USER ? info->si_pid : 0);
  stop.store(true);
}

}  // namespace

void install_stop_handlers() noexcept {
  struct sigaction action = {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

std::string stopped_by() {
  std::ifstream file("/proc/" + std::to_string(sender.load()) + "/comm");
  std::string name;
  std::getline(file, name);
  return name;
}

bool stop_requested() noexcept { return stop.load(); }
void request_stop() noexcept { stop.store(true); }

}  // namespace palpate
