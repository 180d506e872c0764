#include "haptic_node/loop/crash_stop.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>

namespace palpate::haptic {
namespace {

constexpr std::array fatal_signals = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};

std::array<std::atomic<ToolChannel*>, max_tools> watched;
std::atomic<bool> is_ending{false};
static_assert(std::atomic<ToolChannel*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// Takes no lock and no memory: stop() of a driver may be called from a signal handler.
void stop_all() noexcept {
  is_ending.store(true);
  for (auto& slot : watched) {
    ToolChannel* channel = slot.load();
    if (channel == nullptr) continue;
    if (HapticSession* session = channel->session.get()) session->stop_motors();
  }
}

extern "C" void stop_and_die(int signal) {
  stop_all();
  std::raise(signal);  // the handler was reset when it was called
}

}  // namespace

CrashStop::CrashStop(std::vector<std::unique_ptr<ToolChannel>>& channels) {
  for (std::size_t i = 0; i < channels.size() && i < watched.size(); ++i) watched[i].store(channels[i].get());
  struct sigaction action = {};
  action.sa_handler = stop_and_die;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (const int signal : fatal_signals) sigaction(signal, &action, nullptr);
  static const int once = std::atexit([] { stop_all(); });
  static_cast<void>(once);
}

CrashStop::~CrashStop() {
  for (auto& slot : watched) slot.store(nullptr);
  for (const int signal : fatal_signals) std::signal(signal, SIG_DFL);
}

bool CrashStop::ending() noexcept { return is_ending.load(); }

}  // namespace palpate::haptic
