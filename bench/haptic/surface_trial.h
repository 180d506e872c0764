#pragma once
// A hand that presses a block of tissue and slides on it, through a network, in simulated time: trial.h in space.

#include <functional>
#include <memory>
#include <vector>

#include "bench/haptic/energy_book.h"
#include "bench/haptic/link.h"
#include "bench/haptic/plant.h"
#include "bench/haptic/pressed_block.h"
#include "bench/haptic/touch_trials.h"
#include "haptic_node/tissue/surface_touch.h"

namespace palpate::bench {

struct SurfaceCase {
  DeviceModel device = device_models[3];
  HandSpring hand = hand_springs[1];
  double friction = 0.3;
  double stiffness = 500, damping = 1;
  double rate_Hz = 150;  // of frames
  LinkModel link;        // each way
  std::uint32_t modes = 9;
  SurfaceError told;
  bool kinematic = false;    // the hand follows its path exactly
  Vec3 push = Vec3::Zero();  // on the handle while `pushed` lasts, instead of a hand's spring [N]
  double pushed = 0;         // [s]
  std::uint64_t seed = 1;
};
SurfaceCase led_surface(const LinkAge& age, double friction);

/// One sample of the hand; forces on the tissue.
struct SurfaceTouched {
  double t = 0;               // [s]
  Vec3 x = Vec3::Zero();      // true [m]
  Vec3 felt = Vec3::Zero();   // before the hold is paid [N]
  Vec3 borne = Vec3::Zero();  // [N]
  double share = 1;
};

struct SurfaceRun {
  std::vector<SurfaceTouched> samples;  // those at the end that the tissue had not come to are left out
  double surplus = 0;                   // G [J]
  double plane_excess = 0;              // above the bound on the work of corrections [J]
  double made = 0;                      // energy that steps of the copy have made by themselves [J]
  double step_beyond = 0;               // of force in a tick, beyond K v T [N]
};

/// From half a second of waiting before t = 0 at the path's beginning to `until`.
SurfaceRun touch_surface(const SurfaceCase& c, const Path& path, double until);

}  // namespace palpate::bench
