#pragma once
// tissue_touch.h for a tip in space: each answer of physics has a point and a normal of its own, along which the hand's motion counts. Where
// they differ from those of the last answer, the felt copy keeps the force that it has.

#include "common/message/messages.h"
#include "haptic_node/tissue/tissue_touch.h"

namespace palpate::haptic {

class PointTouch {
 public:
  explicit PointTouch(const TouchSettings& settings) noexcept;

  /// An answer newer than the last. Before the next tick().
  void take(const ContactPatch& patch) noexcept;
  /// One tick. Contract: real time. @param gain  as TissueTouch has it
  /// @return force on the hand [N]
  Vec3 tick(const Vec3& x, double gain) noexcept;
  /// What the device really gets of it [N]. After each tick(): felt() follows from it.
  void sent(const Vec3& force) noexcept;
  /// Force on the hand of the newest sample: of what is sent without what it leads by, which pays for the way to the motors [N].
  const Vec3& felt() const noexcept { return felt_; }

  /// By the newest answer: the tip is below the surface.
  bool penetrated(const Vec3& x) const noexcept { return known_ && depth(x) > surface_; }
  const TipHistory& history() const noexcept { return tips_; }
  const TissueTouch& touch() const noexcept { return touch_; }
  /// How far forces that the copy foretold were from those that answers made of the same hand: root of squares over squares.
  double model_error() const noexcept;

 private:
  double depth(const Vec3& x) const noexcept { return normal_.dot(point_ - x); }
  void turn_to(const Vec3& point, const Vec3& normal) noexcept;

  double limit_;  // [N]
  TipHistory tips_;
  TissueTouch touch_;
  double given_ = 0;  // by the last tick() [N]
  Vec3 felt_ = Vec3::Zero();
  bool known_ = false;  // tissue is near, and where
  Vec3 point_ = Vec3::Zero(), normal_ = Vec3::UnitZ();
  double surface_ = 0;            // depth of the newest answer's [m]
  double off2_ = 0, force2_ = 0;  // sums over answers [N^2]
};

}  // namespace palpate::haptic
