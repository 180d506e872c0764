#include "haptic_node/drivers/openhaptics/hd.h"

namespace palpate::haptic::openhaptics {
Hd::Hd(const std::string& file)
    : library("OpenHaptics", file, {"libHD.so", "libHD.so.3.4", "libHD.so.3.0", "libHD.so.3"}) {
  library.find("hdInitDevice", init_device);
  library.find("hdDisableDevice", disable_device);
  library.find("hdMakeCurrentDevice", make_current);
  library.find("hdBeginFrame", begin_frame);
  library.find("hdEndFrame", end_frame);
  library.find("hdGetError", get_error);
  library.find("hdGetErrorString", get_error_string);
  library.find("hdEnable", enable);
  library.find("hdDisable", disable);
  library.find_if_there("hdIsEnabled", is_enabled);
  library.find("hdGetDoublev", get_doubles);
  library.find("hdGetIntegerv", get_integers);
  library.find("hdGetString", get_string);
  library.find("hdSetDoublev", set_doubles);
  library.find("hdCheckCalibration", check_calibration);
  library.find("hdUpdateCalibration", update_calibration);
  library.find("hdScheduleAsynchronous", schedule_asynchronous);
  library.find("hdScheduleSynchronous", schedule_synchronous);
  library.find("hdUnschedule", unschedule);
  library.find("hdSetSchedulerRate", set_scheduler_rate);
  library.find("hdStartScheduler", start_scheduler);
  library.find("hdStopScheduler", stop_scheduler);
}

}  // namespace palpate::haptic::openhaptics
