#include "physics_node/collision/motion_mark.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {

void MotionMark::mark(const Candidates& c) noexcept {
  n_ = c.size();
  std::copy(c.x().begin(), c.x().end(), marked_.begin());
  drift_.setZero();
  stray_ = 0;
}

void MotionMark::measure(const Candidates& c) noexcept {
  drift_.setZero();
  for (std::size_t n = 0; n < n_; ++n) drift_ += c.x()[n] - marked_[n];
  if (n_ > 0) drift_ /= static_cast<double>(n_);
  double most = 0;
  for (std::size_t n = 0; n < n_; ++n) most = std::max(most, (c.x()[n] - marked_[n] - drift_).squaredNorm());
  stray_ = std::sqrt(most);
}

}  // namespace palpate::physics
