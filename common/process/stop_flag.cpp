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

/// nohup and the like: who starts us has decided that this signal means nothing.
bool is_ignored(int signal) noexcept {
  struct sigaction now = {};
  sigaction(signal, nullptr, &now);
  return (now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

void install_stop_handlers() noexcept {
  struct sigaction action = {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  for (const int signal : {SIGHUP, SIGPWR})  // the terminal has gone, the power is going
    if (!is_ignored(signal)) sigaction(signal, &action, nullptr);
  // A write that fails is trouble that somebody reports; one that stops or ends the process is not. SIGTTOU comes to who
  // writes to a terminal from the background.
  for (const int signal : {SIGPIPE, SIGXFSZ, SIGTTOU}) std::signal(signal, SIG_IGN);
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
