#include "haptic_node/loop/crash_stop.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string_view>

#include "common/time/clock.h"
#include "haptic_node/loop/ending_signals.h"

namespace palpate::haptic {
namespace {

std::array<std::atomic<ToolChannel*>, max_tools> watched;
std::atomic<Guardian*> watched_by{nullptr};
std::atomic<LastMoment*> last_moment{nullptr};
std::atomic<int> ender{0};  // thread that ends the process
std::atomic<bool> finished{false};
// A driver that crashes in its own emergency stop is not called again: the next crash of this thread goes on behind it.
std::atomic<std::size_t> told{0}, stopped{0};
std::array<struct sigaction, 128> before;  // by signal: who had it
static_assert(std::atomic<ToolChannel*>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

HapticSession* session_of(std::size_t tool) noexcept {
  ToolChannel* channel = watched[tool].load();
  return channel == nullptr ? nullptr : channel->session.get();
}

void say(std::string_view line) noexcept {
  if (write(STDERR_FILENO, line.data(), line.size()) < 0) return;
}

/// Takes no lock and no memory. First a word to every driver, whose own threads may do it; then one after the other.
/// @return whether all motors are known to be off
bool stop_devices() noexcept {
  const std::int64_t end = now_ns() + CrashStop::stop_ns;
  for (std::size_t i = 0; (i = told.fetch_add(1)) < watched.size();)
    if (HapticSession* session = session_of(i)) session->stop_motors();
  bool all = true;
  for (std::size_t i = 0; (i = stopped.fetch_add(1)) < watched.size();) {
    HapticSession* session = session_of(i);
    if (session == nullptr) continue;
    const std::int64_t left_us = std::max<std::int64_t>((end - now_ns()) / 1000, 1000);
    const bool off = session->emergency_stop(static_cast<std::uint32_t>(left_us));
    if (Guardian* guardian = watched_by.load(); off && guardian != nullptr) guardian->off(i);
    all = all && off;
  }
  return all;
}

/// @param signal  0: exit(code)
void stop_all(int signal, int code) noexcept {
  int nobody = 0;
  if (!ender.compare_exchange_strong(nobody, gettid()) && nobody != gettid()) {
    // Another thread is at it.
    for (std::int64_t end = now_ns() + CrashStop::patience_ns; !finished.load() && now_ns() < end;) {
      const timespec rest{0, 500'000};
      nanosleep(&rest, nullptr);
    }
    return;
  }
  LastMoment* limit = last_moment.load();
  if (limit == nullptr) return;  // nothing is open
  limit->begin(signal, code, gettid());
  const bool again = told.load() > 0;
  const bool all = stop_devices();
  if (signal != 0)
    say(all && !again ? "[haptic] a signal ends this process; the motors of all tools are off\n"
                      : "[haptic] a signal ends this process; MOTORS MAY STILL BE ON: not all drivers have "
                        "confirmed that they are off; let go, press the emergency stop or pull the plug\n");
  finished.store(true);
  limit->done();
}

/// An instruction that fails again does so with the cause and the place that it had.
bool comes_again(int signal, const siginfo_t& info) noexcept {
  return info.si_code > 0 && (signal == SIGSEGV || signal == SIGBUS || signal == SIGILL || signal == SIGFPE);
}

extern "C" void stop_and_die(int signal, siginfo_t* info, void*) {
  stop_all(signal, 0);
  sigaction(signal, &before[static_cast<std::size_t>(signal)], nullptr);
  if (!comes_again(signal, *info)) std::raise(signal);
}

void take(int signal, bool from_anybody) {
  struct sigaction action = {};
  action.sa_sigaction = stop_and_die;
  // Not blocked meanwhile: a driver that crashes in its emergency stop comes here again.
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK | SA_NODEFER);
  sigemptyset(&action.sa_mask);
  struct sigaction& old = before[static_cast<std::size_t>(signal)];
  sigaction(signal, nullptr, &old);
  const bool free = (old.sa_flags & SA_SIGINFO) == 0 && old.sa_handler == SIG_DFL;
  if (from_anybody || free) sigaction(signal, &action, nullptr);
}

void ignore(int signal) {
  struct sigaction action = {};
  action.sa_handler = SIG_IGN;
  sigaction(signal, &action, &before[static_cast<std::size_t>(signal)]);
}

void give_back(int signal) { sigaction(signal, &before[static_cast<std::size_t>(signal)], nullptr); }

void stop_at_exit(int code, void*) { stop_all(0, code); }

}  // namespace

CrashStop::CrashStop(std::vector<std::unique_ptr<ToolChannel>>& channels, Guardian& guardian) {
  for (std::size_t i = 0; i < channels.size() && i < watched.size(); ++i) watched[i].store(channels[i].get());
  watched_by.store(&guardian);
  last_moment.store(&last_moment_);
  for (const int signal : crash_signals()) take(signal, true);
  for (const int signal : stray_signals()) take(signal, false);
  for (const int signal : stop_signals) ignore(signal);
  static const int once = on_exit(stop_at_exit, nullptr) + at_quick_exit([] { stop_all(0, EXIT_FAILURE); });
  static_cast<void>(once);
}

CrashStop::~CrashStop() {
  for (const int signal : crash_signals()) give_back(signal);
  for (const int signal : stray_signals()) give_back(signal);
  for (const int signal : stop_signals) give_back(signal);
  for (auto& slot : watched) slot.store(nullptr);
  last_moment.store(nullptr);
  watched_by.store(nullptr);
}

bool CrashStop::ending() noexcept { return ender.load() != 0; }

}  // namespace palpate::haptic
