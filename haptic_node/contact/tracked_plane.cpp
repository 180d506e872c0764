#include "haptic_node/contact/tracked_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::haptic {

void TrackedPlane::place(const PlaneTarget& target, const Vec3& x) noexcept {
  half_space_.normal = target.normal;
  half_space_.point = x - target.gap * target.normal;
  stiffness_ = target.stiffness;
}

/// Toward `normal` by a fraction of the angle, at most by `most` [rad]. @return by how much
double TrackedPlane::turn(const Vec3& normal, double fraction, double most) noexcept {
  const double cosine = std::clamp(half_space_.normal.dot(normal), -1.0, 1.0);
  const double angle = std::acos(cosine);
  if (angle < 1e-9) {
    half_space_.normal = normal;
    return 0;
  }
  if (angle > 3.1) return 0;  // opposite: no way round is better than another
  const Vec3 across = (normal - cosine * half_space_.normal).normalized();
  const double by = std::min(angle * fraction, most);
  half_space_.normal = (std::cos(by) * half_space_.normal + std::sin(by) * across).normalized();
  return by;
}

/// A compressed spring that stiffens gains k'/2 d^2: the tank pays for it. @return how much the force has changed [N]
double TrackedPlane::stiffen(double stiffness, double pressed, double fraction, double force_step,
                             double share, WorkTank& tank) noexcept {
  double by = (stiffness - stiffness_) * fraction;
  if (pressed > 0) {
    by = std::clamp(by, -force_step / pressed, force_step / pressed);
    const double half_square = 0.5 * share * pressed * pressed;
    if (half_square > 0) by = std::min(by, tank.level() / half_square);
    tank.book(by * half_square);
  }
  stiffness_ += by;
  return std::abs(by) * pressed;
}

/// How far the plane moves along its normal [m].
double TrackedPlane::step(double gap, double target_gap, double pressed, double fraction, double force_step,
                          double share, WorkTank& tank) const noexcept {
  const double by = (gap - target_gap) * fraction;
  const double k = stiffness_;
  if (by > 0) {
    const double free = pressed > 0 ? 0.0 : std::max(gap, 0.0);  // up to the hand it moves for nothing
    const double push = std::min({by - free, force_step / k, tank.affordable(share * k, pressed)});
    if (push <= 0) return std::min(by, free);
    tank.book(share * k * push * (pressed + 0.5 * push));
    return free + push;
  }
  if (pressed <= 0) return by;
  const double give = std::min(-by, force_step / k);
  const double held = std::min(give, pressed);
  tank.book(-share * k * held * (pressed - 0.5 * held));
  return -give;
}

void TrackedPlane::follow(const PlaneTarget& target, const Vec3& x, double pressed, double fraction,
                          double force_step, double share, WorkTank& tank) noexcept {
  const double now = gap(x);
  const double force = stiffness_ * pressed;
  const double most_turn = force > 0 ? force_step / force : std::numeric_limits<double>::infinity();
  force_step -= force * turn(target.normal, fraction, most_turn);
  force_step = std::max(force_step, 0.0);
  force_step -= stiffen(target.stiffness, pressed, fraction, force_step, share, tank);
  const double moved = step(now, target.gap, pressed, fraction, std::max(force_step, 0.0), share, tank);
  half_space_.point = x - (now - moved) * half_space_.normal;
}

}  // namespace palpate::haptic
