#include "haptic_node/drivers/openhaptics/hd_emergency.h"

#include <unistd.h>

#include <array>

#include "haptic_node/drivers/kit/emergency.h"
#include "haptic_node/drivers/openhaptics/hd_device.h"
#include "haptic_node/drivers/openhaptics/hd_errors.h"

namespace palpate::haptic::openhaptics {
namespace {

constexpr std::array<double, 3> none{};

}  // namespace

/// The scheduler's thread lives, unless it has crashed itself or hangs: its next frame sets no force and switches the motors
/// off, in the vendor's order and without a call from here. Only if that does not come is libHD called from here. Never
/// hdStopScheduler or hdDisableDevice: they wait for the scheduler's thread.
hdev_status HdDevice::emergency_stop(std::uint32_t within_us) noexcept {
  doomed_.store(true);
  if (lost_.load()) return HDEV_OK;
  const bool on_scheduler = gettid() == scheduler_thread_.load();
  const auto is_off = [this] { return frame_part_.load() == FramePart::none && !powered_.load(); };
  if (!on_scheduler && kit::comes_true(is_off, within_us / 2)) return HDEV_OK;

  hd_.make_current(scheduled_.device);
  const bool in_frame = frame_part_.load() == FramePart::open;
  if (!in_frame) {
    hd_.disable(HD_FORCE_OUTPUT);  // first: a frame may wait for a device that does not answer
    hd_.begin_frame(scheduled_.device);
  }
  set_effort({});
  hd_.end_frame(scheduled_.device);
  if (in_frame) hd_.disable(HD_FORCE_OUTPUT);
  return HDEV_OK;
}

void rescue_device(const Hd& hd, const std::string& name) {
  forget_errors(hd);
  const HHD device = hd.init_device(name.c_str());
  const HDErrorInfo error = hd.get_error();
  if (error.code != HD_SUCCESS || device == HD_INVALID_HANDLE) throw open_trouble(hd, name, error);
  hd.make_current(device);
  hd.disable(HD_FORCE_OUTPUT);
  hd.begin_frame(device);
  hd.set_doubles(HD_CURRENT_FORCE, none.data());
  hd.end_frame(device);
  hd.disable_device(device);
}

}  // namespace palpate::haptic::openhaptics
