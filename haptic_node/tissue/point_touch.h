#pragma once
// tissue_touch.h for a tip whose contact comes in patches: what physics says of it becomes an answer, and how true answers were is counted.

#include "common/message/messages.h"
#include "haptic_node/tissue/tissue_touch.h"

namespace palpate::haptic {

class PointTouch {
 public:
  /// @param friction  Coulomb's, between tip and tissue
  PointTouch(const TouchSettings& settings, double friction) noexcept
      : friction_(friction), touch_(settings) {}

  /// An answer newer than the last. Before the next tick().
  void take(const ContactPatch& patch) noexcept;
  /// As TissueTouch has it.
  Vec3 tick(const Vec3& x, const Eigen::Quaterniond& q, double gain) noexcept {
    gain_ = gain;
    return touch_.tick(x, q, known_ ? gain : 0.0);
  }
  Vec3 tick(const Vec3& x, double gain) noexcept { return tick(x, Eigen::Quaterniond::Identity(), gain); }
  void sent(const Vec3& force) noexcept { touch_.sent(force); }
  const Vec3& felt() const noexcept { return touch_.felt(); }
  /// Of a force there, about the tip [N m].
  Vec3 torque(const Vec3& force) const noexcept { return touch_.arm().cross(force); }

  /// Of the last tick: what is left of the spring that physics is to press by.
  double gain() const noexcept { return gain_; }
  /// By the newest answer the tip is below the surface.
  bool penetrated(const Vec3& x) const noexcept { return known_ && normal_.dot(x + arm_ - surface_) < 0; }
  const TipHistory& history() const noexcept { return touch_.history(); }
  const TissueTouch& touch() const noexcept { return touch_; }
  /// How far forces that the copy foretold were from those that answers made of the same hand: root of squares over squares.
  double model_error() const noexcept;

 private:
  double friction_;
  TissueTouch touch_;
  bool known_ = false;  // tissue is near, and where: of the newest answer
  Vec3 surface_ = Vec3::Zero(), normal_ = Vec3::UnitZ(), arm_ = Vec3::Zero();
  double gain_ = 0;
  double off2_ = 0, force2_ = 0;  // sums over answers [N^2]
};

}  // namespace palpate::haptic
