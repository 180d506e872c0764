#pragma once
// The plane that the hand feels, on its way to the newest plane that physics sent. Patches come slowly and jump;
// the felt plane moves smoothly, never faster than the hand may be pushed and the work tank can pay.

#include "common/math/vec3.h"
#include "haptic_node/contact/plane_projection.h"
#include "haptic_node/contact/work_tank.h"

namespace palpate::haptic {

/// Where a plane shall be, seen from the hand.
struct PlaneTarget {
  Vec3 normal = Vec3::UnitZ();
  double gap = 0;        // of the hand above it [m]
  double stiffness = 0;  // K K_o / (K + K_o): hand spring and tissue in series [N/m]
};

class TrackedPlane {
 public:
  /// Begins at a given distance from the hand.
  void place(const PlaneTarget& target, const Vec3& x) noexcept;

  /// One tick toward the target.
  /// @param x           hand [m]
  /// @param pressed     depth to which this plane's spring is compressed now [m]; 0: not touched
  /// @param fraction    of the way that is left, (0, 1]
  /// @param force_step  largest change of force that the plane may cause in this tick [N]
  /// @param share       of the plane's force that reaches the hand, 0..1: the plane does that much of its work
  void follow(const PlaneTarget& target, const Vec3& x, double pressed, double fraction, double force_step,
              double share, WorkTank& tank) noexcept;

  /// Moves the plane away from the hand by `retreat` [m].
  void retreat(double retreat) noexcept { half_space_.point -= retreat * half_space_.normal; }

  double gap(const Vec3& x) const noexcept { return half_space_.normal.dot(x - half_space_.point); }
  const HalfSpace& half_space() const noexcept { return half_space_; }
  const Vec3& normal() const noexcept { return half_space_.normal; }
  double stiffness() const noexcept { return stiffness_; }

 private:
  double turn(const Vec3& normal, double fraction, double most) noexcept;
  double stiffen(double stiffness, double pressed, double fraction, double force_step, double share,
                 WorkTank& tank) noexcept;
  double step(double gap, double target_gap, double pressed, double fraction, double force_step, double share,
              WorkTank& tank) const noexcept;

  HalfSpace half_space_;
  double stiffness_ = 0;
};

}  // namespace palpate::haptic
