#include "haptic_node/drivers/openhaptics/hd_calibration.h"

namespace palpate::haptic::openhaptics {

namespace {

/// A device may know several styles, an update names one: that which asks least of a person.
HDenum easiest(int styles) {
  if ((styles & HD_CALIBRATION_AUTO) != 0) return HD_CALIBRATION_AUTO;
  return (styles & HD_CALIBRATION_INKWELL) != 0 ? HD_CALIBRATION_INKWELL : HD_CALIBRATION_ENCODER_RESET;
}

}  // namespace

unsigned int look_at_calibration(void* user) {
  auto& look = *static_cast<CalibrationLook*>(user);
  look.hd->make_current(look.device);
  look.found = look.hd->check_calibration();
  look.hd->get_integers(HD_CALIBRATION_STYLE, &look.style);
  if (look.found == HD_CALIBRATION_NEEDS_UPDATE) look.hd->update_calibration(easiest(look.style));
  return HD_CALLBACK_DONE;
}

const char* calibration_advice(int style) {
  if ((style & HD_CALIBRATION_INKWELL) != 0) return "put the pen into the inkwell";
  if ((style & HD_CALIBRATION_ENCODER_RESET) != 0)
    return "bring the arm to its reset position and start again";
  return "move the arm through its workspace";
}

}  // namespace palpate::haptic::openhaptics
