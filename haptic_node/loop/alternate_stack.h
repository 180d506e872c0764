#pragma once
// A stack for the signal handlers of one thread, for the case that its own has run over.

#include <cstddef>

namespace palpate::haptic {

class AlternateStack {
 public:
  /// What a driver may use in emergency_stop(), besides the frame of the processor's registers.
  static constexpr std::size_t bytes = 96 * 1024;

  /// For the calling thread. Without memory nothing changes.
  AlternateStack() noexcept;
  /// On the same thread.
  ~AlternateStack();
  AlternateStack(const AlternateStack&) = delete;
  AlternateStack& operator=(const AlternateStack&) = delete;

 private:
  void* memory_;
};

}  // namespace palpate::haptic
