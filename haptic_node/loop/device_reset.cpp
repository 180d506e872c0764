#include "haptic_node/loop/device_reset.h"

#include <chrono>

#include "common/error/error.h"
#include "common/report/log.h"

namespace palpate::haptic {

void DeviceReset::step(HapticState state, FaultCause cause) {
  if (channel_.reset_asked.exchange(false) && !busy()) {
    if (state == HapticState::fault || old_ != nullptr)
      reopening_ = true;
    else
      log_warn("{}: asked to end a fault, but there is none", channel_.name);
  }
  if (state != HapticState::fault) fresh_ = false;
  const bool dead =
      state == HapticState::fault && cause == FaultCause::silent && !opening_.valid() && !fresh_;
  if ((reopening_ || dead) && close_old() && reopening_) {
    reopening_ = false;
    if (hangs_)
      log_error("{}: not opened again: its driver has not let go of the device; start palpate again",
                channel_.name);
    else
      opening_ = std::async(std::launch::async, open_);
  }
  if (opening_.valid() && opening_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) take_new();
}

/// A device that could not be opened the last time is closed already. @return false if the session is still in a tick
bool DeviceReset::close_old() {
  if (old_ == nullptr) old_ = channel_.session.take_back();
  if (old_ == nullptr) return false;
  hangs_ = !old_->close();
  return true;
}

void DeviceReset::take_new() {
  try {
    std::unique_ptr<HapticSession> session = opening_.get();
    session->go_on_from(*old_);
    old_.reset();
    channel_.session.offer(std::move(session));
    fresh_ = true;
    log_info("{}: the device is open again", channel_.name);
  } catch (const InputError& error) {
    for (const auto& line : error.complaints()) log_error("{}: not opened again: {}", channel_.name, line);
  }
}

}  // namespace palpate::haptic
