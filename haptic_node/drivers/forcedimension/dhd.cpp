#include "haptic_node/drivers/forcedimension/dhd.h"

namespace palpate::haptic::forcedimension {
Dhd::Dhd(const std::string& file) : library("Force Dimension", file, {"libdhd.so", "libdhd.so.3"}) {
  library.find("dhdGetAvailableCount", get_available_count);
  library.find("dhdOpen", open_first);
  library.find("dhdOpenID", open_id);
  library.find("dhdClose", close);
  library.find("dhdStop", stop);
  library.find("dhdGetSystemType", get_system_type);
  library.find("dhdGetSystemName", get_system_name);
  library.find("dhdGetSerialNumber", get_serial_number);
  library.find("dhdGetSDKVersion", get_sdk_version);
  library.find("dhdErrorGetLastStr", get_last_error);
  library.find("dhdGetPositionAndOrientationFrame", get_position_and_frame);
  library.find("dhdGetLinearVelocity", get_linear_velocity);
  library.find("dhdGetAngularVelocityRad", get_angular_velocity);
  library.find("dhdGetGripperGap", get_gripper_gap);
  library.find("dhdGetButtonMask", get_buttons);
  library.find("dhdSetForceAndTorque", set_effort);
  library.find("dhdEnableForce", enable_force);
  library.find("dhdSetGravityCompensation", set_gravity_compensation);
  library.find("dhdSetMaxForce", set_max_force);
  library.find("dhdGetStatus", get_status);
  library.find("dhdEnableExpertMode", enable_expert_mode);
  library.find("dhdSetWatchdog", set_watchdog);
}

}  // namespace palpate::haptic::forcedimension
