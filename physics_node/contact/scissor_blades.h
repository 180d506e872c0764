#pragma once
// The blades of scissors: they close while the hand presses its button, and open when it lets go.
//
// Their crossing goes on at an even speed, so that a sheet is cut at one; the fingers are as strong as it takes. Open,
// closed or opening they cut nothing.

#include <algorithm>

#include "common/scene/scissors_spec.h"

namespace palpate::physics {

class ScissorBlades {
 public:
  explicit ScissorBlades(const ScissorsSpec& spec) noexcept : spec_(spec), crossing_(spec.open_crossing()) {}

  void press(bool button) noexcept { pressed_ = button, stands_ = false; }
  /// While nothing is heard of the button.
  void stand() noexcept { stands_ = true; }
  /// @param dt  of a step [s]
  void step(double dt) noexcept {
    const double before = crossing_;
    const double on = stands_ ? 0 : (pressed_ ? dt : -dt) * spec_.speed();
    crossing_ = std::clamp(crossing_ + on, spec_.open_crossing(), spec_.closed_crossing());
    way_ = crossing_ - before;
  }
  void reset() noexcept { *this = ScissorBlades(spec_); }

  /// Will they go on in the next step?
  bool closing() const noexcept { return pressed_ && crossing_ < spec_.closed_crossing(); }
  double crossing() const noexcept { return crossing_; }  // from the pivot [m]
  double way() const noexcept { return way_; }            // of that, in the last step [m]
  /// How far it has to go until they are closed [m].
  double left() const noexcept { return spec_.closed_crossing() - crossing_; }
  /// Share of the force that friction takes. What the hand goes on by itself it does not hold tissue against.
  /// @param led  way of the hand ahead in the last step, 0 or more [m]
  double gripped(double led) const noexcept {
    const double own = std::max(0.0, way_), all = own + led;
    return spec_.gripped(crossing_) * (all > 0 ? own / all : 1.0);
  }
  /// That it takes of the handles to press with so much where the blades cross [N m].
  double torque(double force) const noexcept { return force * spec_.way_by_angle(crossing_); }
  const ScissorsSpec& spec() const noexcept { return spec_; }

 private:
  ScissorsSpec spec_;
  double crossing_, way_ = 0;
  bool pressed_ = false, stands_ = false;
};

}  // namespace palpate::physics
