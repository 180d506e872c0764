#include "haptic_node/drivers/simulated/simulated_turn.h"

#include <cmath>

#include "haptic_node/contact/hand_motion.h"
#include "haptic_node/drivers/simulated/simulated_hand.h"

namespace palpate::haptic::simulated {
namespace {

using Eigen::Quaterniond, Eigen::Vector3d;

Quaterniond quaternion(const AttitudePoint& point) {
  return Quaterniond(point.q[0], point.q[1], point.q[2], point.q[3]).normalized();
}

Quaterniond turned_by(const Vector3d& r) noexcept {
  const double angle = r.norm();
  if (angle < 1e-12) return Quaterniond(1, 0.5 * r.x(), 0.5 * r.y(), 0.5 * r.z());
  const Vector3d v = std::sin(0.5 * angle) / angle * r;
  return Quaterniond(std::cos(0.5 * angle), v.x(), v.y(), v.z());
}

}  // namespace

SimulatedTurn::SimulatedTurn(const SimulatedOptions& options, std::int64_t now_ns)
    : options_(options), t_ns_(now_ns) {
  if (!options_.attitudes.empty()) q_ = quaternion(options_.attitudes.front());
}

void SimulatedTurn::start_path() noexcept {
  if (started_) return;
  started_ = true;
  start_ns_ = t_ns_;
}

void SimulatedTurn::path_at(std::int64_t t_ns, Quaterniond& q, Vector3d& w) noexcept {
  w.setZero();
  const auto& points = options_.attitudes;
  if (points.empty()) {
    q.setIdentity();
    return;
  }
  const double t = started_ ? static_cast<double>(t_ns - start_ns_) * 1e-9 : points.front().t;
  while (leg_ + 1 < points.size() && t >= points[leg_ + 1].t) ++leg_;
  const AttitudePoint& from = points[leg_];
  q = quaternion(from);
  if (leg_ + 1 == points.size() || t <= from.t) return;
  const AttitudePoint& to = points[leg_ + 1];
  w = turn_between(q, quaternion(to)) / (to.t - from.t);
  q = turned_by((t - from.t) * w) * q;
}

void SimulatedTurn::advance_to(std::int64_t now_ns, const Array3& torque,
                               std::int64_t torque_until_ns) noexcept {
  if (now_ns - t_ns_ > SimulatedHand::longest_gap_ns) t_ns_ = now_ns - SimulatedHand::longest_gap_ns;
  if (options_.hand.rigid) {
    t_ns_ = now_ns;
    path_at(t_ns_, q_, w_);
    return;
  }
  constexpr double h = step_s;
  const TurnParameters& turn = options_.turn;
  const Vector3d M(torque[0], torque[1], torque[2]);
  const double friction = h / turn.inertia * turn.friction;  // speed that it takes away in a step [rad/s]
  Quaterniond q_path;
  Vector3d w_path;
  while (t_ns_ + step_ns <= now_ns) {
    path_at(t_ns_, q_path, w_path);
    const double on = t_ns_ < torque_until_ns ? 1.0 : 0.0;
    w_ +=
        h / turn.inertia *
        (turn.stiffness * turn_between(q_, q_path) + turn.damping * (w_path - w_) - turn.drag * w_ + on * M);
    const double speed = w_.norm();
    if (friction > 0) w_ *= speed > friction ? 1.0 - friction / speed : 0.0;
    q_ = (turned_by(h * w_) * q_).normalized();
    t_ns_ += step_ns;
  }
}

}  // namespace palpate::haptic::simulated
