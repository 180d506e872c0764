#pragma once
// What a person should know of the shared memory that a session began with: that it is used, and that RouDi, to whom it
// belongs, has come or gone meanwhile.

#include <chrono>
#include <string>

#include "common/wire/shared_memory.h"

namespace palpate::deploy {

class MemoryWatch {
 public:
  /// @param local  the session stays on this machine; else nothing is looked at and nothing said
  explicit MemoryWatch(bool local);

  /// Now and then: one line when something has changed, else empty. Cost: next to nothing, and once a second one system call.
  std::string news();

  /// When the session ends: the same without waiting for the next look.
  std::string last_words();

 private:
  using Clock = std::chrono::steady_clock;
  bool local_;
  RouDi at_start_;
  bool listens_;
  bool greeted_ = false;
  Clock::time_point next_ = Clock::now();
};

}  // namespace palpate::deploy
