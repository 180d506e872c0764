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
/// off, in the vendor's order and without a call from here. If that does not come, the threads that are kept ready call
/// libHD, and only then it is called from here. Never hdStopScheduler, which waits for the scheduler's thread, and no frame.
hdev_status HdDevice::emergency_stop(std::uint32_t within_us) noexcept {
  doomed_.store(true);
  if (lost_.load()) return HDEV_OK;
  stop();
  const bool on_scheduler = gettid() == scheduler_thread_.load();
  const auto is_off = [this] { return stopper_.is_off(); };
  if (!on_scheduler && kit::comes_true(is_off, within_us / 4 * 3)) return HDEV_OK;
  if (stopper_.has_disabled_device()) return HDEV_E_COMM;  // hdDisable hangs
  stopper_.switch_off_here();
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
