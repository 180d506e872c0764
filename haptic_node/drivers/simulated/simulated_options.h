#pragma once
// What can be told to the simulated hand, as text, and what it makes of it.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace palpate::haptic::simulated {

using Array3 = std::array<double, 3>;

/// Linear in between; at rest before the first and after the last.
struct PathPoint {
  double t = 0;  // since the forces were first enabled [s]
  Array3 p{};    // device frame [m]
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

struct SimulatedOptions {
  std::vector<PathPoint> waypoints;  // empty: rests at the origin
  HandParameters hand{0.554, 6.45, 135.0, false};
  DeviceParameters device;
  std::string model = "plain";
  double half_workspace = 0.5;  // a cube about the origin [m]
  double noise = 0;             // standard deviation of measured positions [m]
  std::uint64_t seed = 1;       // of that noise
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
