#pragma once
// For a driver's stop() and emergency_stop(): what a signal handler may do while it waits for a thread that is still alive,
// and threads that are ready for it.

#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <time.h>

#include <cerrno>
#include <cstdint>
#include <thread>
#include <utility>

namespace palpate::haptic::kit {

/// Of the system, not of the host, which may simulate it. Safe in a signal handler.
inline std::int64_t clock_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// Looks five times a millisecond whether it is done. Safe in a signal handler if `done` is. @return whether it is
template <class Done>
bool comes_true(Done&& done, std::uint32_t within_us) noexcept {
  const std::int64_t end = clock_ns() + std::int64_t{within_us} * 1000;
  while (!done()) {
    if (clock_ns() >= end) return false;
    const timespec rest{0, 200'000};
    nanosleep(&rest, nullptr);
  }
  return true;
}

/// A semaphore to sleep at, which stop() may ring from a signal handler.
class Bell {
 public:
  Bell() { sem_init(&bell_, 0, 0); }
  ~Bell() { sem_destroy(&bell_); }
  Bell(const Bell&) = delete;
  Bell& operator=(const Bell&) = delete;
  void ring() noexcept { sem_post(&bell_); }
  void wait() noexcept {
    while (sem_wait(&bell_) != 0 && errno == EINTR) {
    }
  }

 private:
  sem_t bell_;
};

/// A thread that is free when others are busy with a signal: it gets only those of its own crashes.
template <class Body>
std::thread without_signals(Body&& body) {
  sigset_t blocked, before;
  sigfillset(&blocked);
  for (const int own : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGSYS, SIGTRAP}) sigdelset(&blocked, own);
  pthread_sigmask(SIG_SETMASK, &blocked, &before);
  std::thread thread(std::forward<Body>(body));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace palpate::haptic::kit
