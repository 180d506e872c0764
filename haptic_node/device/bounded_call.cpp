#include "haptic_node/device/bounded_call.h"

#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

namespace palpate::haptic {

struct BoundedCall::State {
  std::mutex mutex;
  std::condition_variable changed;
  bool over = false;

  void end() {
    const std::lock_guard<std::mutex> lock(mutex);
    over = true;
    changed.notify_all();
  }
};

BoundedCall::BoundedCall(std::function<void()> call) : state_(std::make_shared<State>()) {
  const auto shared = std::make_shared<std::function<void()>>(std::move(call));
  try {
    std::thread([state = state_, shared] {
      (*shared)();
      state->end();
    }).detach();
  } catch (const std::system_error&) {
    (*shared)();
    state_->end();
  }
}

bool BoundedCall::wait_until(std::chrono::steady_clock::time_point end) const {
  std::unique_lock<std::mutex> lock(state_->mutex);
  return state_->changed.wait_until(lock, end, [this] { return state_->over; });
}

}  // namespace palpate::haptic
