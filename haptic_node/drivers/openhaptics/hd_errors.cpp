#include "haptic_node/drivers/openhaptics/hd_errors.h"

#include <fmt/format.h>

namespace palpate::haptic::openhaptics {

Meaning meaning_of(unsigned int code) noexcept {
  switch (code) {
    case HD_SUCCESS:
      return {};
    case HD_COMM_ERROR:
      return {.transfer_failed = true};
    case HD_WARM_MOTORS:
      return {.fault = HDEV_FAULT_OVERTEMP};
    case HD_EXCEEDED_MAX_FORCE:
    case HD_EXCEEDED_MAX_FORCE_IMPULSE:
      return {.fault = HDEV_FAULT_OVERFORCE};
    case HD_EXCEEDED_MAX_VELOCITY:
      return {.fault = HDEV_FAULT_OVERSPEED};
    case HD_DEVICE_FAULT:
      return {.fault = HDEV_FAULT_POWER};
    default:  // of the program, the timer, the licence: forces cannot be trusted any more
      return {.fault = HDEV_FAULT_INTERNAL};
  }
}

std::string words_of(const Hd& hd, const HDErrorInfo& error) {
  const char* words = hd.get_error_string(error.code);
  return fmt::format("{} (0x{:04x}, internal {})", words == nullptr ? "no words" : words, error.code,
                     error.internal);
}

kit::Trouble open_trouble(const Hd& hd, const std::string& name, const HDErrorInfo& error) {
  const std::string what = fmt::format("device \"{}\" does not open: {}; ", name, words_of(hd, error));
  switch (error.code) {
    case HD_DEVICE_ALREADY_INITIATED:
      return {HDEV_E_BUSY, what + "another tool or program has it"};
    case HD_INVALID_LICENSE:
      return {HDEV_E_SDK, what + "install the vendor's licence"};
    default:
      return {HDEV_E_NODEV,
              what +
                  "plug it in, set it up under that name with the vendor's tool (or give its name as "
                  "id), and let this user open it (group dialout, udev rule for hidraw)"};
  }
}

void forget_errors(const Hd& hd) noexcept {
  for (int i = 0; i < 64 && hd.get_error().code != HD_SUCCESS; ++i) {
  }
}

}  // namespace palpate::haptic::openhaptics
