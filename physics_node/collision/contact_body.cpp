#include "physics_node/collision/contact_body.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {

ContactBody::ContactBody(const MovingBody& moving, bool with_facets, bool with_front)
    : candidates_(moving, with_front) {
  if (with_facets) facets_ = std::make_unique<Facets>(candidates_);
  marked_.resize(candidates_.most());
}

bool ContactBody::follow_breaks() noexcept {
  if (moving().fresh_overflow()) {
    restart();
    return true;
  }
  const auto breaks = moving().fresh_breaks();
  if (breaks.empty()) return false;
  const bool grown = candidates_.follow(breaks) > 0;
  if (facets_) facets_->restart(candidates_);
  return grown || facets_;
}

void ContactBody::restart() noexcept {
  candidates_.restart();
  if (facets_) facets_->restart(candidates_);
  n_marked_ = 0;
}

void ContactBody::mark() noexcept {
  n_marked_ = candidates_.size();
  std::copy(candidates_.x().begin(), candidates_.x().end(), marked_.begin());
  drift_.setZero();
  stray_ = 0;
}

bool ContactBody::refresh(double dt) noexcept {
  const bool finite = candidates_.refresh(dt);
  double most = 0;
  for (const Vec3& v : candidates_.v_move()) most = std::max(most, v.squaredNorm());
  speed_ = std::sqrt(most);
  return finite;
}

void ContactBody::measure_motion() noexcept {
  const auto& x = candidates_.x();
  drift_.setZero();
  for (std::size_t n = 0; n < n_marked_; ++n) drift_ += x[n] - marked_[n];
  if (n_marked_ > 0) drift_ /= static_cast<double>(n_marked_);
  double most = 0;
  for (std::size_t n = 0; n < n_marked_; ++n)
    most = std::max(most, (x[n] - marked_[n] - drift_).squaredNorm());
  stray_ = std::sqrt(most);
}

Eigen::AlignedBox3d ContactBody::box() const noexcept {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : candidates_.x()) box.extend(p);
  return box;
}

std::vector<std::uint32_t> first_candidates(const std::vector<ContactBody>& bodies) {
  std::vector<std::uint32_t> first{0};
  for (const auto& body : bodies)
    first.push_back(first.back() + static_cast<std::uint32_t>(body.candidates().most()));
  return first;
}

double gap_between(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) noexcept {
  return std::max((a.min() - b.max()).maxCoeff(), (b.min() - a.max()).maxCoeff());
}

}  // namespace palpate::physics
