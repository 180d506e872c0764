#pragma once
// The functions and constants of libdhd that the driver uses, declared here: the vendor's headers are no part of palpate.
// Names and values are the vendor's (Force Dimension SDK 3.17). Every function takes the device's number at its end: the
// C++ default argument of the vendor's header does not exist in the library.

#include <string>

#include "haptic_node/drivers/kit/vendor_library.h"

namespace palpate::haptic::forcedimension {

inline constexpr int DHD_OFF = 0, DHD_ON = 1;
inline constexpr int DHD_TIMEGUARD = 1;        // answers that are no errors: too early for new data,
inline constexpr int DHD_MOTOR_SATURATED = 2;  // or the force was more than the motors have
inline constexpr int status_room = 64;         // dhdGetStatus writes 17 numbers now, and wrote fewer before

enum DhdStatus : int {  // index into that
  DHD_STATUS_POWER = 0,
  DHD_STATUS_CONNECTED = 1,
  DHD_STATUS_RESET = 3,
  DHD_STATUS_FORCE = 5,
  DHD_STATUS_ERROR = 9,
  DHD_STATUS_WRIST_DETECTED = 8,
  DHD_STATUS_WRIST_INIT = 12,
  DHD_STATUS_FORCE_OFF_CAUSE = 14,
};

enum DhdForceOff : int {
  DHD_FORCEOFF_NONE = 0,
  DHD_FORCEOFF_BUTTON = 1,
  DHD_FORCEOFF_VELOCITY = 2,
  DHD_FORCEOFF_WATCHDOG = 3,
  DHD_FORCEOFF_SOFTWARE = 4,
  DHD_FORCEOFF_USBDISCN = 5,
  DHD_FORCEOFF_DEADMAN = 6,
};

struct Dhd {
  /// @param file  of libdhd, or empty: the usual names
  /// @throws kit::Trouble (HDEV_E_SDK)
  explicit Dhd(const std::string& file);

  kit::VendorLibrary library;
  int (*get_available_count)();
  int (*open_first)();
  int (*open_id)(char id);
  int (*close)(char id);
  int (*stop)(char id);
  int (*get_system_type)(char id);
  const char* (*get_system_name)(char id);
  int (*get_serial_number)(unsigned short* serial, char id);
  void (*get_sdk_version)(int* major, int* minor, int* release, int* revision);
  const char* (*get_last_error)();
  int (*get_position_and_frame)(double* x, double* y, double* z, double (*r)[3], char id);
  int (*get_linear_velocity)(double* x, double* y, double* z, char id);
  int (*get_angular_velocity)(double* x, double* y, double* z, char id);
  int (*get_gripper_gap)(double* gap, char id);
  unsigned int (*get_buttons)(char id);
  int (*set_effort)(double fx, double fy, double fz, double tx, double ty, double tz, char id);
  int (*enable_force)(unsigned char on, char id);
  int (*set_gravity_compensation)(int on, char id);
  int (*set_max_force)(double newton, char id);
  int (*get_status)(int* status, char id);
  int (*enable_expert_mode)();
  int (*set_watchdog)(unsigned char duration, char id);
};

}  // namespace palpate::haptic::forcedimension
