#pragma once
// The recorded motion of a hand, played to tissue in the hand's own time: a frame goes from the last sample that has been played
// to the newest that has come, however many lie between. So late and lost messages change when tissue is pressed, not how.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>

#include "common/math/vec3.h"
#include "common/message/messages.h"

namespace palpate::physics {

/// Of the samples that a state tells before its newest, how many come after `played`; 0 where its hand begins anew.
/// The record keeps what HandPlay plays: both ask here.
std::uint32_t new_samples(const ToolState& state, std::uint64_t played) noexcept;

/// What is left of a tool's spring: after silence it lets go within 200 ms, and takes hold again as it went.
/// @param left  before a frame of dt, 0 to 1
inline double spring_left(double left, bool heard, double dt) noexcept {
  constexpr double lets_go_in = 0.2;  // [s]
  return std::clamp(left + (heard ? dt : -dt) / lets_go_in, 0.0, 1.0);
}

/// A hand that feels a wrench does not number its samples: its ticks are.
inline ToolState numbered(ToolState state) noexcept {
  if (state.sample == 0) state.sample = state.tick, state.n_before = 0;
  return state;
}

class HandPlay {
 public:
  struct Moment {
    Vec3 x = Vec3::Zero();  // [m]
    Vec3 v = Vec3::Zero();  // smoothed as the hand smooths it: haptic_node/tissue/motion_history.h [m/s]
  };

  /// @param period  between samples [s]
  explicit HandPlay(double period) noexcept;

  /// The coming frame plays up to the sample of this state; none, or one that has been played: the hand stands. A sample that
  /// is late by no more than one leaves it its speed, so that frames as short as that do not shake the damper.
  /// @param dt  of the frame [s]
  /// @return false: a hand that begins anew, at its newest sample
  bool take(const ToolState* state, double dt) noexcept;
  /// @param share  of the frame, from 0 to 1
  Moment at(double share) const noexcept;
  /// Of the handle: of its newest sample alone each state tells that.
  Eigen::Quaterniond attitude(double share) const noexcept { return turned_[0].slerp(share, turned_[1]); }
  /// That it turns by in the frame [rad].
  double turn() const noexcept { return turned_[0].angularDistance(turned_[1]); }
  /// Way of the tip in the frame, straight [m].
  double way() const noexcept { return (path_[n_ - 1].x - path_[0].x).norm(); }

  double period() const noexcept { return period_; }
  bool seen() const noexcept { return last_ > 0; }
  std::uint64_t sample() const noexcept { return last_; }  // that is played by the end of the frame; 0: none
  void reset() noexcept { last_ = 0; }

 private:
  void add(const Vec3& x, std::uint64_t number) noexcept;

  /// Numbered on from the last sample, and by its stamp as old as its number says.
  bool goes_on(const ToolState& state) const noexcept;

  static constexpr double may_be_late = 1.5;  // samples
  // By which stamps and numbers of samples may differ [s]. Why: a hand that was stopped for half a second is the same hand.
  static constexpr double may_differ = 1;

  double period_, share_;
  double stood_ = 0;                    // since a frame played something [s]
  std::uint64_t begin_ = 0, last_ = 0;  // samples at both ends of the frame
  std::int64_t stamp_ns_ = 0;           // of last_
  std::uint64_t first_ = 0;             // of path_[1]: more than one after begin_ where some are lost
  std::size_t n_ = 1;
  std::array<Moment, max_told_samples + 2> path_{};
  std::array<Eigen::Quaterniond, 2> turned_{Eigen::Quaterniond::Identity(), Eigen::Quaterniond::Identity()};
};

}  // namespace palpate::physics
