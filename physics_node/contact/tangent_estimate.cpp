#include "physics_node/contact/tangent_estimate.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr double memory = 0.2;  // of the least squares [s]
constexpr double trusted_speed =
    1.5e-3;                          // of the hand, at which what is learnt weighs as much as the guess [m/s]
constexpr double range = 10;         // times the guess, either way
constexpr double presence = 10e-3;   // after an impulse, in which there still is contact [s]
constexpr double least_along = 0.3;  // of all impulses, that the force is taken to stand for
constexpr double negligible = 1e-3;  // [N]

}  // namespace

void TangentEstimate::Affine::move(const Vec6& motion, const Mat6& to_new_tip) noexcept {
  W = to_new_tip * (W - K * motion);
  K = to_new_tip * K * to_new_tip.transpose();
}

void TangentEstimate::Affine::approach(const Affine& other, double part) noexcept {
  W += part * (other.W - W);
  K += part * (other.K - K);
}

/// k from dF = -k dx along the force.
void TangentEstimate::learn(const Vec3& force, const Vec3& way, double part, double seconds) noexcept {
  const Vec3 force_before = force_.value(), way_before = way_passed_.value();
  force_.pass(force, part);
  way_passed_.pass(way, part);
  const double keep = std::exp(-seconds / memory);
  way_way_ *= keep;
  way_force_ *= keep;
  const double F = force_.value().norm();
  if (F > negligible) {
    const Vec3 n = force_.value() / F;
    const double dx = n.dot(way_passed_.value() - way_before);
    way_way_ += dx * dx;
    way_force_ -= dx * n.dot(force_.value() - force_before);
  }
  const double guess = std::pow(trusted_speed * seconds, 2) * memory / seconds;
  k_ = std::clamp((way_force_ + guess * first_) / (way_way_ + guess), first_ / range, first_ * range);
}

void TangentEstimate::frame(const ContactSum& sum, const Vec6& motion, double seconds,
                            double known) noexcept {
  const double part = low_pass_part(low_pass_Hz_, seconds);
  const Mat6 to_new_tip = lever(-motion.head<3>());
  once_.move(motion, to_new_tip);
  twice_.move(motion, to_new_tip);
  spread_ = to_new_tip * spread_ * to_new_tip.transpose();
  spread_ += part * (sum.spread / seconds - spread_);

  since_contact_ = sum.spread.isZero(0) ? since_contact_ + seconds : 0.0;
  const bool present = since_contact_ < presence;
  Affine now;
  now.W = sum.impulse / seconds;
  // Way without contact makes no force: counted, it would look like soft tissue.
  if (present) way_ += motion.head<3>();
  learn(now.W.head<3>(), way_, part, seconds);
  if (known > 0) k_ = std::clamp(known, first_ / range, first_ * range);

  const double F = force_.value().norm();
  const double all = spread_.topLeftCorner<3, 3>().trace();
  if (present && all > 0 && F > negligible) {
    const Vec3 n = force_.value() / F;
    const double along = n.dot(spread_.topLeftCorner<3, 3>() * n);
    now.K = k_ / std::max(along, least_along * all) * spread_;
  }
  K_ = now.K;
  once_.approach(now, part);
  twice_.approach(once_, part);
}

}  // namespace palpate::physics
