#pragma once
// A call that may never come back, in a thread of its own. Nobody waits for it longer than he wants to; what it uses must
// live for ever or be owned by the call itself.

#include <chrono>
#include <functional>
#include <memory>

namespace palpate::haptic {

class BoundedCall {
 public:
  /// Begins at once. Where no thread is to be had it is made here and now, without a bound.
  explicit BoundedCall(std::function<void()> call);

  /// @return whether it has come back by then
  bool wait_until(std::chrono::steady_clock::time_point end) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace palpate::haptic
