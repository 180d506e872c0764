#pragma once
// [physics] of a scene: how and how often it is stepped.

#include <optional>

#include "common/scene/kinds.h"
#include "common/scene/place.h"

namespace palpate {

struct PhysicsSpec {
  Integrator integrator = Integrator::symplectic_euler;
  std::optional<double> step;  // [s]; absent: "auto", from the stiffness and mass present
  double safety = 0.8;         // fraction of the stable step that "auto" takes, (0, 1]
  Precision precision = Precision::single_;
  int threads = 0;         // 0: as many as pay
  double frame_Hz = 1000;  // one take of the tools and one patch per frame
  bool sleep = true;       // regions at rest are skipped until something moves them
  bool subcycle = false;   // few cells that are much stiffer than the rest take smaller steps of their own
  Place place;
};

}  // namespace palpate
