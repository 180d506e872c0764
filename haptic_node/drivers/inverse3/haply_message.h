#pragma once
// The messages of the Haply Inverse service: JSON. Source: its documentation, version 3.5 (docs.haply.co/inverseSDK).

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace palpate::haptic::inverse3 {

/// What the service says of a device's own condition.
enum class HaplyFlag : std::size_t { power_supply, calibrated, ready };
inline constexpr std::size_t n_haply_flags = 3;
enum class Said : char { nothing, no, yes };

/// What is known of one device. A message changes only what it mentions: the service leaves parts out.
struct HaplyState {
  std::array<double, 3> position{};        // [m]
  std::array<double, 3> velocity{};        // [m/s]
  std::array<double, 4> grip{1, 0, 0, 0};  // attitude of the grip: w, x, y, z
  bool has_grip = false;
  std::uint32_t buttons = 0;  // a, b, c
  std::array<Said, n_haply_flags> flags{};
  std::array<double, 3> applied{};  // force that the device has been given last [N]
  bool tells_applied = false;       // the newest message did

  Said said(HaplyFlag flag) const { return flags[static_cast<std::size_t>(flag)]; }
};

/// Numbers of the devices in a message, in its order.
std::vector<std::string> devices_in(const std::string& message);

/// Takes over what the message says of this device.
/// @return false if it is no message, or says nothing of the device, or something that is no number
bool take_update(const std::string& message, const std::string& device, HaplyState& state);

/// The words of the commands, which differ between versions of the service.
struct Dialect {
  std::string force_key = "values";  // what holds the components of a force
  std::string profile = "palpate";   // the first message names the session
};

/// A force [N].
std::string force_message(const Dialect& dialect, const std::string& device,
                          const std::array<double, 3>& force, bool first);
/// Only a question: no force, no change of what the motors do.
std::string probe_message(const Dialect& dialect, const std::string& device, bool first);

}  // namespace palpate::haptic::inverse3
