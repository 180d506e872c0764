#include "physics_node/collision/motion_mark.h"

#include <algorithm>
#include <cmath>

#include "physics_node/collision/usual_motion.h"

namespace palpate::physics {

void MotionMark::mark(const ContactBody& body, double ahead, double dt, bool alike,
                      std::span<const double> expected) noexcept {
  const Candidates& c = body.candidates();
  n_ = c.size();
  std::copy(c.x().begin(), c.x().end(), marked_.begin());
  for (std::size_t n = 0; n < n_; ++n) extra_[n] = ahead * dt * (alike ? body.speed() : body.speed_of(n));
  for (std::size_t n = 0; n < std::min(n_, expected.size()); ++n)
    extra_[n] = std::max(extra_[n], dt * expected[n]);
  drift_.setZero();
  excess_ = 0;
}

void MotionMark::measure(const ContactBody& body, double need, double dt, bool alike) noexcept {
  const Candidates& c = body.candidates();
  drift_ = usual_motion(n_, [&](std::size_t n) { return Vec3(c.x()[n] - marked_[n]); });
  excess_ = 0;
  for (std::size_t n = 0; n < n_; ++n)
    excess_ = std::max(excess_, excess_of(body, n, need * dt * (alike ? body.speed() : body.speed_of(n))));
}

double MotionMark::excess_of(const ContactBody& body, std::size_t n, double way) const noexcept {
  return travel_per_motion * (body.candidates().x()[n] - marked_[n] - drift_).norm() + way - extra_[n];
}

}  // namespace palpate::physics
