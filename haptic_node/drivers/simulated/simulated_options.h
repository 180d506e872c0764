#pragma once
// What can be told to the simulated hand, as text, and what it makes of it.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace palpate::haptic::simulated {

using Array3 = std::array<double, 3>;

inline constexpr std::int64_t step_ns = 20'000;  // of hand and handle
inline constexpr double step_s = static_cast<double>(step_ns) * 1e-9;

/// Linear in between; at rest before the first and after the last.
struct PathPoint {
  double t = 0;  // since the forces were first enabled [s]
  Array3 p{};    // device frame [m]
};

/// Straight turns in between; at rest before the first and after the last.
struct AttitudePoint {
  double t = 0;                         // since the forces were first enabled [s]
  std::array<double, 4> q{1, 0, 0, 0};  // w, x, y, z; unit; handle to device frame
};

/// While its button is pressed.
struct PressedSpan {
  double from = 0, to = 0;  // since the forces were first enabled [s]
};

/// A hand as a mass on a spring and damper that pull the handle toward the path.
struct HandParameters {
  double mass = 0;       // [kg]
  double damping = 0;    // [N s/m]
  double stiffness = 0;  // [N/m]
  bool rigid = false;    // follows the path exactly, whatever the force
};

/// A device without a hand on it, seen from its handle.
struct DeviceParameters {
  double mass = 0.045;            // apparent mass [kg]
  double damping = 0;             // of its joints [N s/m]
  double friction = 0;            // Coulomb's [N]
  double resolution = 0;          // of its encoders; 0: exact [m]
  double max_force = 7.9;         // of its motors [N]
  double cont_force = 7.9;        // of its motors, for long [N]
  double max_stiffness = 1000.0;  // it claims to render [N/m]
};

/// How the handle turns in the hand. Below zero: what the masses, springs, dampers and frictions of hand and device make as
/// if they were `turn_lever` from the axis.
struct TurnParameters {
  double inertia = -1;    // of hand and handle, the same about every axis [kg m^2]
  double damping = -1;    // of the hand, toward the path [N m s/rad]
  double stiffness = -1;  // of the hand, toward the path [N m/rad]
  double friction = -1;   // Coulomb's, of the device [N m]
  double drag = 0;        // damping of the device's joints; always from its model [N m s/rad]
  double max_torque = 0;  // of the motors; 0: it has none that turn [N m]
};
inline constexpr double turn_lever = 0.03;  // assumed: half the width of what a hand holds [m]

struct SimulatedOptions {
  std::vector<PathPoint> waypoints;      // empty: rests at the origin
  std::vector<AttitudePoint> attitudes;  // empty: the identity
  std::vector<PressedSpan> pressed;      // empty: it has no button
  HandParameters hand{0.554, 6.45, 135.0, false};
  DeviceParameters device;
  TurnParameters turn;
  std::string model = "plain";
  double half_workspace = 0.5;  // a cube about the origin [m]
  double noise = 0;             // standard deviation of measured positions [m]
  std::uint64_t seed = 1;       // of that noise

  /// It measures its attitude: somebody asked for attitudes or for torques.
  bool turns() const noexcept { return turn.max_torque > 0 || !attitudes.empty(); }
};

/// Hand models: arm (Sci. Rep. srep18004, fig. 3: mass, damper and spring fitted to one trial), pinch (light grip of two fingers)
/// and firm (whole hand), both assumed within published spreads, and rigid.
/// Device models: plain (no friction, exact), touch, premium and omega, which are like the devices of these names: masses,
/// dampings and frictions are assumed, forces and resolutions are from data sheets. A key after the model overrides it.
/// @param kv        2 n_kv texts: key, value, ...
/// @param options   filled in
/// @return empty, or one line: which key or value is wrong and what would be right
std::string parse_options(const char* const* kv, std::uint32_t n_kv, SimulatedOptions& options);

}  // namespace palpate::haptic::simulated
