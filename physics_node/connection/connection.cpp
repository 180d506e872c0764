#include "physics_node/connection/connection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/math/state_hash.h"

namespace palpate::physics {

namespace {

/// What a strand takes that has passed what it holds since the last step.
struct Tear {
  double pulled = 0;  // in that step, by where it was before: U + F / 2 times its way [J]
  double impulse =
      0;  // between its ends, for what that lacks of its toughness: J r - w J^2 / 2 of what moves them apart at r [N s]
  double by_impulse = 0;  // [J]
};
/// @param apart  r, its rate [m/s]  @param w  inverse mass between its ends [1/kg]
Tear tear_of(const Strand& strand, double longer, double apart, double w, double dt_before) noexcept {
  Tear tear;
  const double before = std::max(0.0, longer - dt_before * std::max(0.0, apart));
  tear.pulled = 0.5 * strand.k * before * longer;
  const double lacks = 0.5 * strand.k * strand.most_longer * strand.most_longer - tear.pulled;
  if (!(apart > 0) || !(w > 0) || !(lacks > 0)) return tear;
  tear.impulse = (apart - std::sqrt(std::max(0.0, apart * apart - 2 * w * lacks))) / w;
  tear.by_impulse = tear.impulse * apart - 0.5 * w * tear.impulse * tear.impulse;
  return tear;
}

}  // namespace

Connection::Connection(std::vector<Strand> strands, BodyModel& from, BodyModel& to)
    : strands_(std::move(strands)),
      from_(&from),
      to_(&to),
      torn_(strands_.size(), 0),
      saved_(Torn{torn_}, Torn{torn_}) {
  on_from_.reserve(strands_.size());
  on_to_.reserve(3 * strands_.size());
}

Connection::Now Connection::now(const Strand& strand) const noexcept {
  Vec3 d = -from_->position(strand.node);
  for (std::size_t c = 0; c < 3; ++c) d += strand.share[c] * to_->position(strand.foot[c]);
  const double length = d.norm();
  if (!(length > strand.length)) return {};
  return {length - strand.length, d / length};
}

/// Of a force on the first body, and its opposite on the second [W].
double Connection::power(const Strand& strand, const Vec3& force) const noexcept {
  Vec3 v = from_->velocity(strand.node);
  for (std::size_t c = 0; c < 3; ++c) v -= strand.share[c] * to_->velocity(strand.foot[c]);
  return force.dot(v);
}

void Connection::find_forces(double dt) noexcept {
  on_from_.clear();
  on_to_.clear();
  watched_ = pull_ = 0;
  const auto pull = [&](const Strand& strand, const Vec3& force) {
    pull_ += force.norm();
    on_from_.push_back({strand.node, force});
    for (std::size_t c = 0; c < 3; ++c)
      if (strand.share[c] > 0) on_to_.push_back({strand.foot[c], -strand.share[c] * force});
  };
  const auto inverse_mass = [](const BodyModel& body, Index node) {
    return body.body().inverse_mass[static_cast<std::size_t>(node)];
  };
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    if (torn_[s] != 0) continue;
    const Strand& strand = strands_[s];
    const Now at = now(strand);
    if (at.longer <= 0) continue;
    if (at.longer < strand.most_longer) {
      const Vec3 force = strand.k * at.longer * at.u;
      watched_ += 0.5 * strand.k * at.longer * at.longer + 0.5 * dt * power(strand, force);
      pull(strand, force);
      continue;
    }
    double w = inverse_mass(*from_, strand.node);
    for (std::size_t c = 0; c < 3; ++c)
      w += strand.share[c] * strand.share[c] * inverse_mass(*to_, strand.foot[c]);
    const Tear tear = tear_of(strand, at.longer, -power(strand, at.u), w, dt_before_);
    torn_[s] = 1;
    ++n_torn_;
    broken_ += tear.pulled + tear.by_impulse;
    watched_ -= tear.by_impulse;  // which bodies lose in this step
    if (tear.impulse > 0) pull(strand, tear.impulse / dt * at.u);
  }
  dt_before_ = dt;
}

void Connection::act(double dt) noexcept {
  if (on_from_.empty()) return;
  from_->kick(on_from_, dt);
  to_->kick(on_to_, dt);
}

double Connection::energy() const noexcept {
  double sum = 0;
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    if (torn_[s] != 0) continue;
    const Now at = now(strands_[s]);
    const Vec3 force = strands_[s].k * at.longer * at.u;
    sum += 0.5 * strands_[s].k * at.longer * at.longer + 0.5 * dt_before_ * power(strands_[s], force);
  }
  return sum;
}

void Connection::save(bool good) noexcept {
  Torn& to = saved_.next(good);
  std::ranges::copy(torn_, to.of.begin());
  to.broken = broken_, to.n = n_torn_;
}

void Connection::restore() noexcept {
  const Torn& from = saved_.good();
  std::ranges::copy(from.of, torn_.begin());
  broken_ = from.broken, n_torn_ = from.n;
  dt_before_ = 0;
}

void Connection::reset() noexcept {
  std::ranges::fill(torn_, std::uint8_t(0));
  watched_ = broken_ = pull_ = dt_before_ = 0;
  n_torn_ = 0;
  save(false);
  save(true);
}

std::uint64_t Connection::hash(std::uint64_t seed) const noexcept {
  return hash_state(torn_.data(), torn_.size(), seed);
}

}  // namespace palpate::physics
