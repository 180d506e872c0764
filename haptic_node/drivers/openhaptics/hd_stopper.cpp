#include "haptic_node/drivers/openhaptics/hd_stopper.h"

#include "haptic_node/drivers/kit/emergency.h"

namespace palpate::haptic::openhaptics {

HdStopper::HdStopper(const Hd& hd) : hd_(hd) {
  frame_ends();
  first_ = kit::without_signals([this] { keep_ready_to_disable(); });
  second_ = kit::without_signals([this] { keep_ready_to_disable_device(); });
}

HdStopper::~HdStopper() {
  leaving_.store(true);
  wake_.ring();
  wake_second_.ring();
  first_.join();
  second_.join();
}

void HdStopper::ask() noexcept {
  asked_.store(true);
  wake_.ring();
}

void HdStopper::switch_off_here() noexcept {
  hd_.make_current(device_.load());
  hd_.disable(HD_FORCE_OUTPUT);
  off_.store(true);
}

void HdStopper::keep_ready_to_disable() noexcept {
  while (true) {
    wake_.wait();
    if (leaving_.load()) return;
    if (!asked_.exchange(false)) continue;
    constexpr std::uint32_t late_us = late_ns / 1000;
    kit::comes_true([this] { return is_off() || is_late(); }, 2 * late_us);
    if (is_off() || !is_late() || device_.load() == HD_INVALID_HANDLE) continue;
    busy_.store(true);
    if (!kit::comes_true([this] { return is_off(); }, settle_us)) {
      wake_second_.ring();
      switch_off_here();
    }
    busy_.store(disabled_device_.load());
  }
}

void HdStopper::keep_ready_to_disable_device() noexcept {
  while (true) {
    wake_second_.wait();
    if (leaving_.load()) return;
    if (kit::comes_true([this] { return is_off(); }, disable_within_us)) continue;
    disabled_device_.store(true);
    hd_.disable_device(device_.load());  // an attempt: no document says that it switches motors off
  }
}

}  // namespace palpate::haptic::openhaptics
