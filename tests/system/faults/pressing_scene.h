#pragma once
// A small block of tissue and a rigid hand that presses it by 4 mm twice in three seconds, for as long as a test may take.

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
  // In 3 s: pressed for half a second, and for one and a half.
  for (int begin = 0; begin < 1200; begin += 3) {
    const std::string at = std::to_string(begin), then = std::to_string(begin + 1),
                      last = std::to_string(begin + 2);
    text += ", [" + at + ".30, 0, 0, 24], [" + at + ".45, 0, 0, 16], [" + at + ".90, 0, 0, 16], [" + at +
            ".99, 0, 0, 24]";
    text += ", [" + then + ".30, 0, 0, 24], [" + then + ".45, 0, 0, 16], [" + last + ".90, 0, 0, 16], [" +
            last + ".99, 0, 0, 24]";
  }
  return text + "]\n";
}

}  // namespace palpate::test
