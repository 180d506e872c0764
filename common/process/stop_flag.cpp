#include "common/process/stop_flag.h"

#include <atomic>
#include <csignal>

namespace palpate {
namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void on_signal(int) { stop.store(true); }

}  // namespace

void install_stop_handlers() noexcept {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

bool stop_requested() noexcept { return stop.load(); }
void request_stop() noexcept { stop.store(true); }

}  // namespace palpate
