#pragma once
// How far the candidates of a body have moved since somebody last looked, apart from what all did together.

#include <vector>

#include "physics_node/collision/candidates.h"

namespace palpate::physics {

class MotionMark {
 public:
  explicit MotionMark(std::size_t most) : marked_(most, Vec3::Zero()) {}

  /// Remembers where they are now.
  void mark(const Candidates& c) noexcept;
  /// Since then, of those that there were:
  void measure(const Candidates& c) noexcept;
  const Vec3& drift() const { return drift_; }  // the mean displacement [m]
  double stray() const { return stray_; }       // how far one strayed from it at most [m]

 private:
  std::vector<Vec3> marked_;
  std::size_t n_ = 0;
  Vec3 drift_ = Vec3::Zero();
  double stray_ = 0;
};

}  // namespace palpate::physics
