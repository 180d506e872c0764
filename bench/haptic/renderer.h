#pragma once
// From patches to the force on the hand. `local` is the production controller; the others are what it replaces, kept
// to be compared with: without them a harness that calls everything stable could not be told from a good controller.

#include <cstdint>

#include "haptic_node/control/controller.h"

namespace palpate::bench {

enum class RenderMode {
  local,       // haptic::Controller
  raw_planes,  // the newest plane as it comes: F = K d n - B v_n, no tank, no interpolation
  direct,      // force computed by physics at its own rate and held until the next one comes
  copy,        // haptic::TissueTouch: tissue pressed by the hand's recorded motion, a copy of it felt
  extrapolated  // the force that such tissue bore, continued with its stiffness, no tank: F = F_s + K_t (x - x_s)
};
const char* name_of(RenderMode mode) noexcept;

/// What a renderer says of itself after a tick.
struct Rendered {
  Vec3 force = Vec3::Zero();     // for the device [N]
  Vec3 reported = Vec3::Zero();  // for physics [N]
  Vec3 proxy = Vec3::Zero();     // [m]
  double stored = 0;             // [J]
  double plane_work = 0;         // so far [J]
  bool touching = false;
  bool want_power = false;
};

/// F = K (p - x) along n on the deepest facet, as it comes; not below zero, not above `limit`.
Rendered raw_plane_force(const ContactPatch& patch, const Vec3& x, const Vec3& v,
                         const haptic::ControllerSettings& settings) noexcept;

/// Modes in which physics presses its tissue by the hand's recorded motion.
inline bool is_pressed_by_motion(RenderMode mode) noexcept {
  return mode == RenderMode::copy || mode == RenderMode::extrapolated;
}

/// The production controller's answer to one tick. Energy is that of a spring whose force ends at the limit.
Rendered local_force(haptic::Controller& controller, std::int64_t now_ns, const haptic::DeviceSample& sample,
                     const ContactPatch* patch, const ToolWrench* wrench = nullptr) noexcept;

}  // namespace palpate::bench
