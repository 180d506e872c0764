#include "physics_node/collision/contact_impulses.h"

#include <utility>

namespace palpate::physics {

ContactImpulses::ContactImpulses(const std::vector<ContactBody>& bodies)
    : first_(first_candidates(bodies)),
      taken_(bodies.size()),
      felt_(bodies.size(), 0),
      count_(bodies.size(), 1) {
  const std::size_t n = first_.back();
  dv_.assign(n, Vec3::Zero());
  is_touched_.assign(n, 0);
  counted_in_.assign(n, 0);
  touched_.reserve(n);
}

ContactSum BodyImpulse::sum_about(const Vec3& p) const {
  ContactSum sum;
  sum.impulse << linear, angular;
  sum.spread = spread;
  return sum.about(-p);
}

void ContactImpulses::begin_step() noexcept {
  for (const PairEnd& at : touched_) {
    dv_[first_[at.body] + at.n].setZero();
    is_touched_[first_[at.body] + at.n] = 0;
  }
  touched_.clear();
  driven_work_ = 0;
}

void ContactImpulses::touch(PairEnd at) noexcept {
  std::uint8_t& touched = is_touched_[first_[at.body] + at.n];
  if (touched != 0) return;
  touched = 1;
  touched_.push_back(at);
}

void ContactImpulses::push(const std::vector<ContactBody>& bodies, PairEnd at, const Vec3& J) noexcept {
  const Candidates& c = bodies[at.body].candidates();
  BodyImpulse& taken = taken_[at.body];
  taken.linear += J;
  taken.angular += c.x()[at.n].cross(J);
  if (felt_[at.body] != 0) {
    ContactSum one;
    one.add(J, c.x()[at.n]);
    taken.spread += one.spread;
  }
  std::uint32_t& counted = counted_in_[first_[at.body] + at.n];
  if (counted != count_[at.body]) ++taken.masses;
  counted = count_[at.body];
  const double w = c.inverse_mass(at.n);
  if (w == 0) {
    driven_work_ -= J.dot(c.v()[at.n]);
    return;
  }
  touch(at);
  dv_[first_[at.body] + at.n] += w * J;
}

Vec3 ContactImpulses::set_change(const std::vector<ContactBody>& bodies, PairEnd at,
                                 const Vec3& dv) noexcept {
  const double w = bodies[at.body].candidates().inverse_mass(at.n);
  if (w == 0) return Vec3::Zero();
  const Vec3 J = (dv - dv_[first_[at.body] + at.n]) / w;
  push(bodies, at, J);
  return J;
}

BodyImpulse ContactImpulses::take(std::uint32_t b) noexcept {
  ++count_[b];
  return std::exchange(taken_[b], BodyImpulse{});
}

}  // namespace palpate::physics
