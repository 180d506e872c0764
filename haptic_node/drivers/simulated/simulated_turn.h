#pragma once
// How the handle of a device turns in a hand that aims it along a path of attitudes, in the steps of simulated_hand.h.
//
//   J w' = k r + b (w_p - w) - b_d w - f_c w/|w| + M        q' = (0, w) q / 2
//
// r is the rotation vector from the attitude q to that of the path, w_p the path's angular velocity, M the device's torque,
// b_d and f_c damping and Coulomb friction of the device. J is the same about every axis, so that there is no gyroscopic
// moment. At rest a torque turns the hand by M / k. Axes are those of the device.

#include <Eigen/Geometry>
#include <cstdint>

#include "haptic_node/drivers/simulated/simulated_options.h"

namespace palpate::haptic::simulated {

class SimulatedTurn {
 public:
  SimulatedTurn(const SimulatedOptions& options, std::int64_t now_ns);

  /// The path begins at the time reached so far; only the first call counts.
  void start_path() noexcept;

  /// Steps to `now_ns` under `torque` [N m], which ends when `torque_until_ns` has passed.
  void advance_to(std::int64_t now_ns, const Array3& torque, std::int64_t torque_until_ns) noexcept;

  const Eigen::Quaterniond& attitude() const noexcept { return q_; }  // handle to device
  const Eigen::Vector3d& velocity() const noexcept { return w_; }     // [rad/s]

 private:
  void path_at(std::int64_t t_ns, Eigen::Quaterniond& q, Eigen::Vector3d& w) noexcept;

  const SimulatedOptions& options_;
  std::int64_t t_ns_;
  std::int64_t start_ns_ = 0;
  bool started_ = false;
  std::size_t leg_ = 0;  // between attitude leg_ and the next
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d w_ = Eigen::Vector3d::Zero();
};

}  // namespace palpate::haptic::simulated
