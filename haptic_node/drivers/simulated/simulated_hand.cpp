#include "haptic_node/drivers/simulated/simulated_hand.h"

#include <algorithm>
#include <cmath>

namespace palpate::haptic::simulated {

SimulatedHand::SimulatedHand(const SimulatedOptions& options, std::int64_t now_ns)
    : options_(options), t_ns_(now_ns) {
  if (!options_.waypoints.empty()) x_ = options_.waypoints.front().p;
}

void SimulatedHand::start_path() noexcept {
  if (started_) return;
  started_ = true;
  start_ns_ = t_ns_;
}

bool SimulatedHand::presses() const noexcept {
  if (!started_) return false;
  const double t = 1e-9 * static_cast<double>(t_ns_ - start_ns_);
  return std::ranges::any_of(options_.pressed,
                             [&](const PressedSpan& span) { return t >= span.from && t < span.to; });
}

void SimulatedHand::path_at(std::int64_t t_ns, Array3& q, Array3& q_dot) noexcept {
  q_dot = {};
  const auto& points = options_.waypoints;
  if (points.empty()) {
    q = {};
    return;
  }
  const double t = started_ ? static_cast<double>(t_ns - start_ns_) * 1e-9 : points.front().t;
  while (leg_ + 1 < points.size() && t >= points[leg_ + 1].t) ++leg_;
  const PathPoint& from = points[leg_];
  if (leg_ + 1 == points.size() || t <= from.t) {
    q = from.p;
    return;
  }
  const PathPoint& to = points[leg_ + 1];
  for (std::size_t i = 0; i < 3; ++i) {
    q_dot[i] = (to.p[i] - from.p[i]) / (to.t - from.t);
    q[i] = from.p[i] + q_dot[i] * (t - from.t);
  }
}

void SimulatedHand::advance_to(std::int64_t now_ns, const Array3& force,
                               std::int64_t force_until_ns) noexcept {
  if (now_ns - t_ns_ > longest_gap_ns) t_ns_ = now_ns - longest_gap_ns;
  Array3 q{}, q_dot{};
  if (options_.hand.rigid) {
    t_ns_ = now_ns;
    path_at(t_ns_, x_, v_);
    return;
  }
  constexpr double h = step_s;
  const double m = options_.hand.mass + options_.device.mass;
  const double k = options_.hand.stiffness;
  const double b = options_.hand.damping;
  const double b_d = options_.device.damping;
  const double friction = h / m * options_.device.friction;  // speed that it takes away in a step [m/s]
  while (t_ns_ + step_ns <= now_ns) {
    path_at(t_ns_, q, q_dot);
    const double on = t_ns_ < force_until_ns ? 1.0 : 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      v_[i] += h / m * (k * (q[i] - x_[i]) + b * (q_dot[i] - v_[i]) - b_d * v_[i] + on * force[i]);
    }
    const double speed = std::sqrt(v_[0] * v_[0] + v_[1] * v_[1] + v_[2] * v_[2]);
    const double slides = speed > friction ? 1.0 - friction / speed : 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (friction > 0) v_[i] *= slides;
      x_[i] += h * v_[i];
    }
    t_ns_ += step_ns;
  }
}

}  // namespace palpate::haptic::simulated
