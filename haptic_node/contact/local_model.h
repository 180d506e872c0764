#pragma once
// What a tool feels between two answers of physics, by the model that the scene names. One of them works, the others cost
// nothing.

#include "common/math/vec3.h"
#include "common/message/messages.h"
#include "common/scene/kinds.h"
#include "haptic_node/contact/local_contact.h"
#include "haptic_node/contact/tangent_wrench.h"
#include "haptic_node/tissue/point_touch.h"

namespace palpate::haptic {

class LocalModel {
 public:
  /// @param stiffness, damping, limit  of the spring between hand and tool [N/m], [N s/m], [N]
  /// @param torque_limit  0: the device gives none [N m]
  /// @param period, resolution  of samples [s], [m]
  /// @param grip  of a tool that holds tissue [N]; 0: it only pushes
  LocalModel(ForceModel model, double stiffness, double damping, double limit, double torque_limit,
             double friction, double period, double resolution, double grip) noexcept
      : model_(model),
        stiffness_(stiffness),
        damping_(damping),
        limit_(limit),
        planes_(stiffness, damping, limit, friction),
        tangent_(stiffness, damping, limit, torque_limit, grip),
        torque_limit_(torque_limit),
        tissue_({{stiffness, damping}, period, limit, resolution, torque_limit > 0}, friction) {}

  /// Forces come from wrenches; otherwise from patches.
  bool needs_wrench() const noexcept { return model_ == ForceModel::tangent || model_ == ForceModel::direct; }
  /// Bounds the energy that it gives. The other two are for comparison.
  bool is_passive() const noexcept {
    return model_ == ForceModel::norton || model_ == ForceModel::tangent || limits_itself();
  }
  /// Takes gains and the limit of energy in itself: what tick() gives goes to the device as it is.
  bool limits_itself() const noexcept { return model_ == ForceModel::tissue; }

  void take(const ContactPatch& patch, double period) noexcept {
    if (model_ == ForceModel::norton)
      planes_.take(patch, period);
    else if (limits_itself())
      tissue_.take(patch);
    else
      patch_ = patch;
  }
  void take(const ToolWrench& wrench, double period) noexcept {
    if (model_ == ForceModel::tangent)
      tangent_.take(wrench, period);
    else
      wrench_ = wrench;
  }

  /// By the newest answer the tool is in the tissue: arming there would begin with a force.
  bool penetrated(const HandMotion& hand) const noexcept;

  /// Contract: real time.
  /// @param share  of the force that reached the hand in the last tick
  /// @param gain   what the state leaves of the force; of one that limits itself alone
  ContactResult tick(const HandMotion& hand, double dt, double share, double gain) noexcept;
  /// A tick in which nothing is felt.
  void rest(const HandMotion& hand) noexcept {
    if (limits_itself()) tissue_.tick(hand.x, hand.q, 0);
  }
  /// What the device gets [N].
  void sent(const Vec3& force) noexcept {
    if (limits_itself()) tissue_.sent(force);
  }

  /// The force becomes `keep` (0..1) of what it is at x.
  void weaken(const Vec3& x, double keep) noexcept {
    planes_.weaken(x, keep);
    tangent_.weaken(keep);
  }
  /// The next contact begins at zero force.
  void release() noexcept { planes_.release(), tangent_.release(); }

  /// The force is about to grow by itself: how much of `work` may be done so now, booked [J].
  double pay(double work) noexcept {
    if (!is_passive() || limits_itself()) return work;
    return model_ == ForceModel::norton ? planes_.pay(work) : tangent_.pay(work);
  }

  /// Work of moving planes and springs on the hand since the start [J].
  double work() const noexcept {
    return planes_.plane_work() + tangent_.work() + tissue_.touch().correction_work();
  }
  /// Energy that it gives and has not been given, of one that limits itself [J].
  double surplus() const noexcept { return tissue_.touch().leak(); }
  const PointTouch& tissue() const noexcept { return tissue_; }

 private:
  ForceModel model_;
  double stiffness_, damping_, limit_;
  LocalContact planes_;
  TangentWrench tangent_;
  double torque_limit_;
  PointTouch tissue_;
  ContactPatch patch_{};  // raw_planes
  ToolWrench wrench_{};   // direct
};

}  // namespace palpate::haptic
