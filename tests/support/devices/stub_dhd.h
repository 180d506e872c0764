#pragma once
// A stand-in for Force Dimension's libdhd: the same exported functions, two devices without hardware, and a record of
// whether it was used as the vendor's documents ask.

#include <array>
#include <string>
#include <vector>

namespace palpate::test {

struct StubDhdDevice {
  int type = 33;                     // omega.3
  std::array<double, 3> position{};  // [m]
  std::array<double, 9> frame{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> velocity{}, angular_velocity{};
  double gap = 0.01;
  unsigned int buttons = 0;
  bool powered = true, connected = true, resetting = false, wrist = false, wrist_ready = false, error = false;
  int force_off_cause = 0;  // set together with force_on = false: the device let go
  int measure_answer = 0;   // of the measuring functions: 1 timeguard, negative an error
  bool has_watchdog = true;
  bool opens = true;

  // What was done to it.
  bool open = false, force_on = false, stopped = false, gravity = false;
  int watchdog = 0, forces_set = 0;
  double max_force = 0;
  std::array<double, 6> effort{};
};

class StubDhd {
 public:
  virtual ~StubDhd() = default;
  virtual void reset() = 0;
  virtual StubDhdDevice& device(int i) = 0;
  virtual std::vector<std::string> breaches() = 0;
  virtual std::vector<std::string> calls() = 0;
  /// Waits for a call of dhdStop for the device. @return false if none comes
  virtual bool stop_comes(int i) = 0;
};

/// Exported as "stub_dhd".
using StubDhdFunction = StubDhd*();

}  // namespace palpate::test
