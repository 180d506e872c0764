#pragma once
// A block in an image that a ball presses by forces that are given, all of it computed or only what is near to the ball.

#include <functional>
#include <optional>
#include <vector>

#include "common/math/vec3.h"

namespace palpate::bench {

struct PressedBlock {
  std::string folder;  // of the image that it makes
  std::array<int, 3> cells{80, 80, 40};
  double edge = 0.0025;  // of a cell [m]
  double tip = 0.005;    // radius [m]
  double poisson_ratio = 0.45;
  bool held = true;               // below; else only what is not computed holds it
  std::optional<double> awake{};  // none: all of it is computed [m]
};

/// What the ball does in a frame of 1 ms: the force along -z, and where, beside the middle of the upper face.
struct Press {
  double force = 0;            // [N]
  Vec3 beside = Vec3::Zero();  // [m]
};

struct Pressed {
  std::vector<double> depth;      // after each frame [m]
  double cpu_s = 0;               // of all frames, this thread
  double awake_share = 1;         // of the masses, at the end
  double numerical = 0;           // energy that waking, sleeping and following the finger gave or took [J]
  double exchanged = 0, off = 0;  // see EnergyLedger [J], of 1
};

Pressed press(const PressedBlock& block, int frames, const std::function<Press(int)>& way);

}  // namespace palpate::bench
