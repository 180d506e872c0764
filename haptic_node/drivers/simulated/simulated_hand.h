#pragma once
// A hand that holds the handle of a device and follows a path, in small fixed steps of simulated or real time.
//
//   m x'' = k (q(t) - x) + b (q'(t) - x') - b_d x' - f_c x'/|x'| + F
//
// m = hand + device, q(t) the path, F the device's force, b_d and f_c damping and Coulomb friction of the device, which
// sticks where the other forces are smaller than f_c. Without friction a force moves the hand by F / k at rest.

#include <cstdint>

#include "haptic_node/drivers/simulated/simulated_options.h"

namespace palpate::haptic::simulated {

class SimulatedHand {
 public:
  static constexpr std::int64_t longest_gap_ns =
      2'000'000'000;  // a longer absence is skipped, not integrated

  SimulatedHand(const SimulatedOptions& options, std::int64_t now_ns);

  /// The path begins at the time reached so far; only the first call counts.
  void start_path() noexcept;

  /// Steps to `now_ns` under `force` [N], which ends (a device's own watchdog) when `force_until_ns` has passed.
  void advance_to(std::int64_t now_ns, const Array3& force, std::int64_t force_until_ns) noexcept;

  /// Is its button pressed?
  bool presses() const noexcept;
  const Array3& position() const noexcept { return x_; }
  const Array3& velocity() const noexcept { return v_; }

 private:
  void path_at(std::int64_t t_ns, Array3& q, Array3& q_dot) noexcept;

  const SimulatedOptions& options_;
  std::int64_t t_ns_;
  std::int64_t start_ns_ = 0;
  bool started_ = false;
  std::size_t leg_ = 0;  // between waypoint leg_ and the next
  Array3 x_{}, v_{};
};

}  // namespace palpate::haptic::simulated
