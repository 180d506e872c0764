#pragma once
// A stand-in for the vendor's libHD: the same exported functions, two devices without hardware, and a record of whether
// it was used as the vendor's documents ask. Built as a library of its own, loaded by the driver like the real one.

#include <array>
#include <string>
#include <vector>

namespace palpate::test {

struct StubHdDevice {
  std::string name;
  int output_dof = 3;
  std::array<double, 16> transform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // columns, [mm]
  std::array<double, 3> velocity{};                                                  // [mm/s]
  std::array<double, 3> angular_velocity{};                                          // [rad/s]
  int buttons = 0;
  double temperature = 0.25;
  int calibration_style = 2;
  unsigned int calibration = 0x5000;  // what the next look finds
  bool calibrates_when_updated = true;
  bool unplugged = false;       // every frame raises HD_COMM_ERROR
  unsigned int init_error = 0;  // raised by hdInitDevice

  // What was done to it.
  bool open = false, in_frame = false, force_on = false, clamping = false, ramping = false;
  std::array<double, 3> force{}, torque{};  // as set last [N], [mN m]
  int frames = 0;
};

class StubHd {
 public:
  virtual ~StubHd() = default;
  virtual void reset() = 0;                          // two devices, calm
  virtual StubHdDevice& device(unsigned int i) = 0;  // 0 "Default PHANToM", 1 "left" with six driven axes
  virtual void tick(int n) = 0;                      // runs the scheduled callbacks here
  virtual void use_thread(bool yes) = 0;             // or in a thread of the scheduler, at 1 kHz
  virtual void raise(unsigned int i, unsigned int code) = 0;  // at the end of the device's next frame
  /// From now on no callback comes, and whoever waits for the scheduler waits until it speaks again.
  virtual void fall_silent(bool yes) = 0;
  virtual std::vector<std::string> breaches() = 0;  // of the rules of use
  virtual std::vector<std::string> calls() = 0;     // the rare ones, in order
};

/// For tests that start whole programs, in the environment:
///   STUB_HD_PRESSES   the hand presses by so many mm, see stub_hd.cpp
///   STUB_HD_TROUBLE   once 0.1 N have been set 200 times: "silent" as fall_silent(); "off" forces switch themselves off;
///                     "warm" the motors warm up from 0.75 to their limit in 1250 frames, where they raise HD_WARM_MOTORS
///   STUB_HD_LOG       file to which each rare call is added as a line when it is made
/// Exported as "stub_hd".
using StubHdFunction = StubHd*();

}  // namespace palpate::test
