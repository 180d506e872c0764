#include "haptic_node/loop/last_moment.h"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>

#include "common/process/silent_thread.h"
#include "haptic_node/loop/realtime.h"
#include "haptic_node/loop/realtime_loop.h"

namespace palpate::haptic {
namespace {

constexpr auto step = std::chrono::milliseconds(20);

}  // namespace

LastMoment::LastMoment(std::int64_t patience_ns) : patience_ns_(patience_ns) {
  sem_init(&wake_, 0, 0);
  thread_ = silent_thread([this] { wait(); });
}

LastMoment::~LastMoment() {
  leaving_.store(true);
  sem_post(&wake_);
  thread_.join();
  sem_destroy(&wake_);
}

void LastMoment::begin(int signal, int code, pid_t thread) noexcept {
  if (begun_.exchange(true)) return;
  signal_ = signal;
  code_ = code;
  ending_thread_ = thread;
  sem_post(&wake_);
}

void LastMoment::wait() noexcept {
  enter_realtime(RealtimeLoop::watchdog_priority);
  while (sem_wait(&wake_) != 0 && errno == EINTR) {
  }
  if (leaving_.load()) return;
  std::this_thread::sleep_for(std::chrono::nanoseconds(patience_ns_));
  if (!done_.load()) end();
}

/// To the thread first, so that a core dump shows where it was; then to any; then without asking.
void LastMoment::end() noexcept {
  if (signal_ == 0) _exit(code_);
  std::signal(signal_, SIG_DFL);
  tgkill(getpid(), ending_thread_, signal_);
  std::this_thread::sleep_for(step);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal_);
  pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  kill(getpid(), signal_);
  std::this_thread::sleep_for(step);
  kill(getpid(), SIGKILL);
  _exit(code_);
}

}  // namespace palpate::haptic
