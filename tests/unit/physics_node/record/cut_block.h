#pragma once
// A block that a blade cuts, and a hand that leads the blade.

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/physics/recorded_hand.h"

namespace palpate::physics::test {

/// @param body  further keys of the block
inline std::string cut_block(const std::string& body) {
  return R"(
gravity_m_per_s2 = [0, 0, 0]
[physics]
precision = "double"
frame_Hz = 1000
[[body]]
name = "block"
shape = "box"
size_mm = [16, 16, 10]
spacing_mm = 2
material = "m"
fixed = ["-y", "+y"]
)" + body +
         R"(
[material.m]
density_kg_per_m3 = 1000
modulus_kPa = 200
viscosity_Pa_s = 5
cut_toughness_J_per_m2 = 190
[[tool]]
name = "blade"
shape = "scalpel"
length_mm = 20
edge_deg = 0
stiffness_N_per_m = 1000
device = "hand"
[device.hand]
driver = "simulated"
waypoints = [[0, 60, 0, 0], [1, 50, 0, 0]]
)";
}

/// Into the block until 0.15 s, and out of it again.
/// @param speed     [m/s]
/// @param clock_ns  of the hand at frame 0
inline ToolState led_blade(int frame, double speed = 0.4, std::int64_t clock_ns = 0) {
  ToolState state = recorded_hand(
      [speed](double t) {
        return Vec3(0.014 - speed * std::max(0.03 - std::abs(t - 0.15), 0.0), 0.0003, -0.010);
      },
      static_cast<std::uint64_t>(frame) + 1);
  state.stiffness = 1000;
  state.stamp_ns = clock_ns + 1'000'000 * std::int64_t{frame};
  return state;
}

}  // namespace palpate::physics::test
