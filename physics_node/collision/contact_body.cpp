#include "physics_node/collision/contact_body.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {

ContactBody::ContactBody(const BodyModel& moving, bool with_facets, bool with_front,
                         const Fragments* fragments)
    : candidates_(moving, with_front), fragments_(fragments) {
  if (with_facets) facets_ = std::make_unique<Facets>(candidates_);
  listed_.reserve(candidates_.most());
  is_listed_.assign(candidates_.most(), 0);
  speeds_.assign(candidates_.most(), 0.0);
  find_main_piece();
}

void ContactBody::follow_breaks() noexcept {
  const TopologyEvents events = moving().events();
  if (events.overflow) return restart();
  if (events.none()) return;
  changed_ = true;
  candidates_.follow(events);
  find_main_piece();
  if (facets_) facets_->restart(candidates_);
}

void ContactBody::restart() noexcept {
  candidates_.restart();
  find_main_piece();
  if (facets_) facets_->restart(candidates_);
  clear_listed();
  changed_ = true;
  moved_ = speed_ = 0;
  shift_.setZero();
  shifted_.setZero();
}

void ContactBody::find_main_piece() noexcept {
  if (fragments_ == nullptr) return;
  const auto& masses = fragments_->masses();
  main_piece_ = static_cast<Index>(std::max_element(masses.begin(), masses.end()) - masses.begin());
}

bool ContactBody::may_meet_itself(std::size_t candidate) const noexcept {
  const Index cell = candidates_.cell()[candidate];
  return fragments_ == nullptr || fragments_->label(cell) != main_piece_ ||
         moving().adjacency().has_lost(cell);
}

bool ContactBody::read(double dt, std::span<const std::uint32_t> which) noexcept {
  const bool finite = candidates_.refresh(dt, which, shift_);
  shifted_ += shift_;
  shift_.setZero();
  measure_speed(which);
  moved_ += candidates_.moved();
  return finite;
}

void ContactBody::measure_speed(std::span<const std::uint32_t> which) noexcept {
  speed_ = 0;
  for (const std::uint32_t n : which) {
    speeds_[n] = (candidates_.v_move()[n] - common_).norm();
    speed_ = std::max(speed_, speeds_[n]);
  }
}

void ContactBody::go_with(const Vec3& velocity) noexcept {
  common_ = velocity;
  shift_.setZero();
  measure_speed(candidates_.all());
}

void ContactBody::clear_listed() noexcept {
  for (const std::uint32_t n : listed_) is_listed_[n] = 0;
  listed_.clear();
}

void ContactBody::list(std::uint32_t candidate) noexcept {
  if (is_listed_[candidate] != 0) return;
  is_listed_[candidate] = 1;
  listed_.push_back(candidate);
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
