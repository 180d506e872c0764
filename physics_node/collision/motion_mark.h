#pragma once
// How far the candidates of a body have moved since pairs of them were listed, apart from what all did
// together, and how far each of them may.

#include <span>
#include <vector>

#include "physics_node/collision/contact_body.h"

namespace palpate::physics {

class MotionMark {
 public:
  explicit MotionMark(std::size_t most) : marked_(most, Vec3::Zero()), extra_(most, 0.0) {}

  /// Remembers where they are now, and gives each what it needs besides what all have: ahead dt v, v its
  /// speed against the body's common velocity, and dt times what is expected of it (without: nothing).
  /// @param alike  all as if each were as fast as the fastest
  /// @param expected  speed of each [m/s]; none: of nobody
  void mark(const ContactBody& body, double ahead, double dt, bool alike,
            std::span<const double> expected) noexcept;
  /// Since then, of those that there were; drift() and excess() tell what came out. @param need  as `ahead`,
  /// in this step
  void measure(const ContactBody& body, double need, double dt, bool alike) noexcept;
  /// The usual displacement [m].
  const Vec3& drift() const { return drift_; }
  /// By how much one has moved and needs more than it was given, at most; at least 0 [m].
  double excess() const { return excess_; }
  /// The same of one candidate that goes so far in this step [m].
  double excess_of(const ContactBody& body, std::size_t n, double way) const noexcept;
  /// What each was given [m].
  std::span<const double> extra() const { return {extra_.data(), n_}; }

 private:
  std::vector<Vec3> marked_;
  std::vector<double> extra_;
  std::size_t n_ = 0;
  Vec3 drift_ = Vec3::Zero();
  double excess_ = 0;
};

/// A mass and a facet move towards each other, and the distance at which they touch grows with the edges: by
/// 2 / (2 sqrt(3)) of what the corners move.
constexpr double travel_per_motion = 1.6;

}  // namespace palpate::physics
