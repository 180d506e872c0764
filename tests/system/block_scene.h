#pragma once
// A soft block that a rigid hand with a round tip presses, as a scene: what the tests of the hand's faults have in common.

#include <fmt/format.h>

#include <string>

namespace palpate::test {

inline constexpr double block_stiffness = 400;  // of the hand spring [N/m]
inline constexpr double block_force_limit = 3;  // [N]

/// 80 x 80 x 40 mm about the origin, its top at z = 20 mm.
/// @param waypoints  as the scene writes them: "[t_s, x_mm, y_mm, z_mm], ..."
inline std::string block_scene(int frame_Hz, double spacing_mm, const std::string& waypoints) {
  return fmt::format(R"(title = "A block and a tip"
gravity_m_per_s2 = [0, 0, 0]
[physics]
frame_Hz = {}
[material.soft]
density_kg_per_m3 = 1000.0
modulus_kPa = 10.0
viscosity_Pa_s = 1.0
[[body]]
name = "block"
lattice = "voxel"
spacing_mm = {}
shape = "box"
size_mm = [80, 80, 40]
fixed = ["-z"]
material = "soft"
[[tool]]
name = "tip"
radius_mm = 16.0
device = "hand"
stiffness_N_per_m = {}
[render]
size_px = [320, 240]
rate_Hz = 10
[device.hand]
driver = "simulated"
hand = "rigid"
force_limit_N = {}
waypoints = [{}]
)",
                     frame_Hz, spacing_mm, block_stiffness, block_force_limit, waypoints);
}

}  // namespace palpate::test
