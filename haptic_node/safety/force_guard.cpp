#include "haptic_node/safety/force_guard.h"

#include <algorithm>

namespace palpate::haptic {
namespace {

/// Shortened to `most`; direction kept. A squared norm that overflows is handled as well.
Vec3 clamped(const Vec3& f, double most) noexcept {
  const double largest = f.cwiseAbs().maxCoeff();
  if (largest <= 0) return f;
  const double norm = largest * (f / largest).norm();
  if (norm <= most) return f;
  return (f / largest) * (most / (f / largest).norm());
}

}  // namespace

Vec3 ForceGuard::pass(const Vec3& wanted, double gain, bool falling, double moved) noexcept {
  Vec3 f = wanted.allFinite() ? wanted : Vec3(Vec3::Zero());
  f = clamped(f, limit_);
  // A force may go at once, never come at once.
  const Vec3 along = before_gain_.squaredNorm() > 0 ? Vec3(before_gain_.normalized()) : Vec3(Vec3::Zero());
  const double falls = std::clamp(before_gain_.norm() - f.dot(along), 0.0, before_gain_.norm());
  const Vec3 start = before_gain_ - falls * along;
  f = start + clamped(f - start, std::min(jump_, stiffness_ * moved + kick));
  before_gain_ = f;
  const double kept = gain > 0 ? std::min(gain, 1.0) : 0.0;  // false for not a number
  f *= kept;
  if (falling) f = clamped(f, last_.norm());
  last_ = f;
  return f;
}

}  // namespace palpate::haptic
