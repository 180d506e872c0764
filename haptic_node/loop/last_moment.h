#pragma once
// Ends the process if whoever is ending it takes too long: motors are stopped by vendors' libraries, which may hang.

#include <semaphore.h>
#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <thread>

namespace palpate::haptic {

class LastMoment {
 public:
  /// Starts a thread that sleeps.
  explicit LastMoment(std::int64_t patience_ns);
  ~LastMoment();
  LastMoment(const LastMoment&) = delete;
  LastMoment& operator=(const LastMoment&) = delete;

  /// From a signal handler: unless done() comes in time, this signal ends the process, as it would have `thread`. The first
  /// call counts.
  /// @param signal  0: exit(code) is on its way
  void begin(int signal, int code, pid_t thread) noexcept;
  void done() noexcept { done_.store(true); }

 private:
  void wait() noexcept;
  [[noreturn]] void end() noexcept;

  std::int64_t patience_ns_;
  sem_t wake_;
  std::atomic<bool> begun_{false}, done_{false}, leaving_{false};
  int signal_ = 0, code_ = 0;
  pid_t ending_thread_ = 0;
  std::thread thread_;
};

}  // namespace palpate::haptic
