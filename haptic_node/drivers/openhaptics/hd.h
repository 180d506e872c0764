#pragma once
// The functions and constants of libHD that the driver uses, declared here: the vendor's headers are under a licence of
// their own and are no part of palpate. Names and values are the vendor's (OpenHaptics 3.0 HD API).

#include <string>

#include "haptic_node/drivers/kit/vendor_library.h"

namespace palpate::haptic::openhaptics {

using HHD = unsigned int;
using HDenum = unsigned int;
using HDhandle = unsigned long;  // of a scheduled callback
using HDCallback = unsigned int (*)(void*);

struct HDErrorInfo {
  unsigned int code;
  int internal;
  HHD device;
};
static_assert(sizeof(HDErrorInfo) == 12, "returned by value");

inline constexpr HHD HD_INVALID_HANDLE = 0xFFFFFFFFu;
inline constexpr unsigned int HD_CALLBACK_DONE = 0, HD_CALLBACK_CONTINUE = 1;
inline constexpr unsigned short HD_MAX_SCHEDULER_PRIORITY = 65535, HD_DEFAULT_SCHEDULER_PRIORITY = 32767;

enum HdError : unsigned int {
  HD_SUCCESS = 0x0000,
  HD_INVALID_ENUM = 0x0100,
  HD_INVALID_VALUE = 0x0101,
  HD_INVALID_OPERATION = 0x0102,
  HD_INVALID_INPUT_TYPE = 0x0103,
  HD_BAD_HANDLE = 0x0104,
  HD_WARM_MOTORS = 0x0200,
  HD_EXCEEDED_MAX_FORCE = 0x0201,
  HD_EXCEEDED_MAX_FORCE_IMPULSE = 0x0202,
  HD_EXCEEDED_MAX_VELOCITY = 0x0203,
  HD_FORCE_ERROR = 0x0204,
  HD_DEVICE_FAULT = 0x0300,
  HD_DEVICE_ALREADY_INITIATED = 0x0301,
  HD_COMM_ERROR = 0x0302,
  HD_COMM_CONFIG_ERROR = 0x0303,
  HD_TIMER_ERROR = 0x0304,
  HD_ILLEGAL_BEGIN = 0x0400,
  HD_ILLEGAL_END = 0x0401,
  HD_FRAME_ERROR = 0x0402,
  HD_INVALID_PRIORITY = 0x0500,
  HD_SCHEDULER_FULL = 0x0501,
  HD_INVALID_LICENSE = 0x0600,
};

enum HdParameter : HDenum {
  HD_CURRENT_BUTTONS = 0x2000,
  HD_CURRENT_VELOCITY = 0x2051,          // mm/s
  HD_CURRENT_TRANSFORM = 0x2052,         // 16 numbers, column after column, translation in mm
  HD_CURRENT_ANGULAR_VELOCITY = 0x2053,  // rad/s
  HD_VERSION = 0x2500,
  HD_DEVICE_MODEL_TYPE = 0x2501,
  HD_DEVICE_VENDOR = 0x2503,
  HD_DEVICE_SERIAL_NUMBER = 0x2504,
  HD_USABLE_WORKSPACE_DIMENSIONS = 0x2551,  // 6 numbers [mm]
  HD_INPUT_DOF = 0x2553,
  HD_OUTPUT_DOF = 0x2554,
  HD_CALIBRATION_STYLE = 0x2555,
  HD_NOMINAL_MAX_STIFFNESS = 0x2602,         // N/mm, as the vendor's examples use it
  HD_NOMINAL_MAX_FORCE = 0x2603,             // N
  HD_NOMINAL_MAX_CONTINUOUS_FORCE = 0x2604,  // N
  HD_MOTOR_TEMPERATURE = 0x2605,             // 0 to 1, one for each motor
  HD_NOMINAL_MAX_TORQUE_FORCE = 0x2622,      // mN m
  HD_CURRENT_FORCE = 0x2700,                 // N
  HD_CURRENT_TORQUE = 0x2701,                // mN m
  HD_FORCE_OUTPUT = 0x4000,
  HD_MAX_FORCE_CLAMPING = 0x4001,
  HD_FORCE_RAMPING = 0x4002,
  HD_CALIBRATION_OK = 0x5000,
  HD_CALIBRATION_NEEDS_UPDATE = 0x5001,
  HD_CALIBRATION_NEEDS_MANUAL_INPUT = 0x5002,
};

enum HdCalibrationStyle : int {
  HD_CALIBRATION_ENCODER_RESET = 1,
  HD_CALIBRATION_AUTO = 2,
  HD_CALIBRATION_INKWELL = 4
};

/// The functions themselves.
struct Hd {
  /// @param file  of libHD, or empty: the usual names
  /// @throws kit::Trouble (HDEV_E_SDK)
  explicit Hd(const std::string& file);

  kit::VendorLibrary library;
  HHD (*init_device)(const char* name);
  void (*disable_device)(HHD device);
  void (*make_current)(HHD device);
  void (*begin_frame)(HHD device);
  void (*end_frame)(HHD device);
  HDErrorInfo (*get_error)();
  const char* (*get_error_string)(unsigned int code);
  void (*enable)(HDenum what);
  void (*disable)(HDenum what);
  unsigned char (*is_enabled)(HDenum what);  // null where the library lacks it
  void (*get_doubles)(HDenum what, double* values);
  void (*get_integers)(HDenum what, int* values);
  const char* (*get_string)(HDenum what);
  void (*set_doubles)(HDenum what, const double* values);
  HDenum (*check_calibration)();
  void (*update_calibration)(HDenum style);
  HDhandle (*schedule_asynchronous)(HDCallback callback, void* user, unsigned short priority);
  void (*schedule_synchronous)(HDCallback callback, void* user, unsigned short priority);
  void (*unschedule)(HDhandle callback);
  void (*set_scheduler_rate)(unsigned long rate_Hz);
  void (*start_scheduler)();
  void (*stop_scheduler)();
};

}  // namespace palpate::haptic::openhaptics
