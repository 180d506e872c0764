#pragma once
// Whether libHD trusts the positions of a device, and what a person can do about it.

#include "haptic_node/drivers/openhaptics/hd.h"

namespace palpate::haptic::openhaptics {

/// What one look finds. Passed to look_at_calibration().
struct CalibrationLook {
  const Hd* hd;
  HHD device;
  HDenum found = 0;
  int style = 0;
};

/// For hdScheduleSynchronous: looks, in the vendor's thread, and updates what needs no person.
/// @param user  a CalibrationLook
unsigned int look_at_calibration(void* user);

/// For a device of this style [HdCalibrationStyle bits].
const char* calibration_advice(int style);

}  // namespace palpate::haptic::openhaptics
