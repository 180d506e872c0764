#include "physics_node/connection/connection.h"

#include <algorithm>
#include <utility>

#include "common/math/state_hash.h"

namespace palpate::physics {

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
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    if (torn_[s] != 0) continue;
    const Strand& strand = strands_[s];
    const Now at = now(strand);
    if (at.longer <= 0) continue;
    const double held = 0.5 * strand.k * at.longer * at.longer;
    if (at.longer >= strand.most_longer) {
      torn_[s] = 1;
      ++n_torn_;
      broken_ += held;
      continue;
    }
    const Vec3 force = strand.k * at.longer * at.u;
    pull_ += force.norm();
    watched_ += held + 0.5 * dt * power(strand, force);
    on_from_.push_back({strand.node, force});
    for (std::size_t c = 0; c < 3; ++c)
      if (strand.share[c] > 0) on_to_.push_back({strand.foot[c], -strand.share[c] * force});
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
