#pragma once
// A small block of tissue and a rigid hand that presses it by 4 mm once a second, for as long as a test may take.

#include <string>

namespace palpate::test {

inline constexpr double pressing_stiffness = 400;  // of the hand spring [N/m]
inline constexpr double pressing_force_limit = 3;  // [N]

inline std::string pressing_scene() {
  std::string text = R"(title = "A block, pressed again and again"
gravity_m_per_s2 = [0, 0, 0]
[physics]
frame_Hz = 500
[material.soft]
density_kg_per_m3 = 1000.0
modulus_kPa = 10.0
viscosity_Pa_s = 1.0
[[body]]
name = "block"
lattice = "voxel"
spacing_mm = 8.0
shape = "box"
size_mm = [80, 80, 40]
fixed = ["-z"]
material = "soft"
[[tool]]
name = "tip"
radius_mm = 16.0
device = "hand"
[render]
size_px = [320, 240]
rate_Hz = 10
[device.hand]
driver = "simulated"
hand = "rigid"
waypoints = [[0, 0, 0, 24])";
  for (int second = 0; second < 1200; ++second) {
    const std::string s = std::to_string(second);
    text += ", [" + s + ".30, 0, 0, 24], [" + s + ".45, 0, 0, 16], [" + s + ".90, 0, 0, 16], [" + s +
            ".99, 0, 0, 24]";
  }
  return text + "]\n";
}

}  // namespace palpate::test
