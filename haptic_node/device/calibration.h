#pragma once
// From the frame of a device to the world and back.
//
//   x_w = s R x_d + o        v_w = s R v_d        F_d = f_s R^T F_w        M_d = (f_s / s) R^T M_w
//
// The hand then feels the stiffness f_s s K_w, and the energies at the port obey E_d = (f_s / s) E_w.
// Source: Takada, Abe et al. (rotation of the device into the world); scale and offset are ours.

#include <Eigen/Core>

#include "common/math/vec3.h"
#include "common/scene/scene_fwd.h"

namespace palpate::haptic {

class Calibration {
 public:
  /// @throws InputError at spec.place: R not a rotation (R^T R = 1 within 1e-3, det +1), scale or force_scale not
  ///         above zero, or anything not finite. R is made exactly orthonormal afterwards.
  explicit Calibration(const DeviceSpec& spec);

  Vec3 world_from_device(const Vec3& x_d) const noexcept { return scale_ * (rotation_ * x_d) + offset_; }
  Vec3 device_from_world(const Vec3& x_w) const noexcept {
    return rotation_.transpose() * (x_w - offset_) / scale_;
  }
  Vec3 velocity_to_world(const Vec3& v_d) const noexcept { return scale_ * (rotation_ * v_d); }
  Vec3 turned_to_world(const Vec3& w_d) const noexcept { return rotation_ * w_d; }
  Vec3 force_to_device(const Vec3& f_w) const noexcept {
    return force_scale_ * (rotation_.transpose() * f_w);
  }
  Vec3 torque_to_device(const Vec3& m_w) const noexcept {
    return force_scale_ / scale_ * (rotation_.transpose() * m_w);
  }
  Vec3 force_to_world(const Vec3& f_d) const noexcept { return rotation_ * f_d / force_scale_; }

  const Eigen::Matrix3d& rotation() const noexcept { return rotation_; }
  double scale() const noexcept { return scale_; }
  double force_scale() const noexcept { return force_scale_; }
  /// K_d = stiffness_gain() K_w
  double stiffness_gain() const noexcept { return force_scale_ * scale_; }

 private:
  Eigen::Matrix3d rotation_;
  double scale_;
  double force_scale_;
  Vec3 offset_;
};

}  // namespace palpate::haptic
