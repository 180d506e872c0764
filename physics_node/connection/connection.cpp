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
/// @param k  of what is left of it [N/m]  @param apart  r, its rate [m/s]
/// @param w  inverse mass between its ends [1/kg]
Tear tear_of(const Strand& strand, double k, double longer, double apart, double w,
             double dt_before) noexcept {
  Tear tear;
  const double before = std::max(0.0, longer - dt_before * std::max(0.0, apart));
  tear.pulled = 0.5 * k * before * longer;
  const double lacks = 0.5 * k * strand.most_longer * strand.most_longer - tear.pulled;
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
      left_(strands_.size(), 1.0),
      damping_(strands_.size(), Vec3::Zero()),
      saved_(Left{left_}, Left{left_}),
      marked_{left_} {
  on_from_.reserve(strands_.size());
  on_to_.reserve(3 * strands_.size());
  for (const Strand& strand : strands_) {
    rest_.push_back(-from_->body().rest_position(strand.node));
    for (std::size_t c = 0; c < 3; ++c)
      rest_.back() += strand.share[c] * to_->body().rest_position(strand.foot[c]);
  }
  with_net([this](const auto& net) { find_elements(net); });
}

/// Calls visit(net) where the second body is a mesh that may be cut.
template <class Visit>
void Connection::with_net(const Visit& visit) const {
  const MeshBody* mesh = to_->body().mesh.get();
  if (mesh != nullptr && mesh->net) visit(*mesh->net);
  if (mesh != nullptr && mesh->triangles) visit(*mesh->triangles);
}

template <class Net>
void Connection::find_elements(const Net& net) {
  on_element_.resize(strands_.size());
  for (std::size_t s = 0; s < strands_.size(); ++s)
    net.each_corner(strands_[s].foot[0], [&](Index element, std::size_t) {
      OnElement on{.element = element};
      const auto& corners = net.corners(element);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto at = std::ranges::find(corners, strands_[s].foot[c]);
        if (at == corners.end()) return;
        on.corner[c] = static_cast<std::uint8_t>(at - corners.begin());
      }
      on_element_[s] = on;
    });
}

void Connection::take_feet() noexcept {
  with_net([this](const auto& net) {
    for (std::size_t s = 0; s < on_element_.size(); ++s) {
      const auto& corners = net.corners(on_element_[s].element);
      for (std::size_t c = 0; c < 3; ++c) strands_[s].foot[c] = corners[on_element_[s].corner[c]];
    }
  });
}

void Connection::follow() noexcept {
  if (!on_element_.empty() && !to_->events().nodes_split.empty()) take_feet();
}

Connection::Ends Connection::places(const Strand& strand) const noexcept {
  Ends ends{from_->position(strand.node), Vec3::Zero()};
  for (std::size_t c = 0; c < 3; ++c) ends.foot += strand.share[c] * to_->position(strand.foot[c]);
  return ends;
}

Connection::Ends Connection::velocities(const Strand& strand) const noexcept {
  Ends ends{from_->velocity(strand.node), Vec3::Zero()};
  for (std::size_t c = 0; c < 3; ++c) ends.foot += strand.share[c] * to_->velocity(strand.foot[c]);
  return ends;
}

double Connection::inverse_mass_of_node(const Strand& strand) const noexcept {
  return from_->body().inverse_mass[static_cast<std::size_t>(strand.node)];
}

double Connection::inverse_mass_of_foot(const Strand& strand, std::size_t corner) const noexcept {
  return to_->body().inverse_mass[static_cast<std::size_t>(strand.foot[corner])];
}

Connection::Now Connection::now(std::size_t s) const noexcept {
  const Strand& strand = strands_[s];
  Vec3 d = rest_[s] - from_->displacement(strand.node);
  for (std::size_t c = 0; c < 3; ++c) d += strand.share[c] * to_->displacement(strand.foot[c]);
  const double length = d.norm();
  if (!(length > strand.length)) return {};
  return {length - strand.length, d / length};
}

/// Of a force on the first body, and its opposite on the second [W].
double Connection::power(const Strand& strand, const Vec3& force) const noexcept {
  const Ends v = velocities(strand);
  return force.dot(v.node - v.foot);
}

void Connection::put(const Strand& strand, const Vec3& on_node, const Vec3& on_foot) noexcept {
  on_from_.push_back({strand.node, on_node});
  for (std::size_t c = 0; c < 3; ++c)
    if (strand.share[c] > 0) on_to_.push_back({strand.foot[c], strand.share[c] * on_foot});
}

/// As much as it may take from a pull, and no more: it does not push.
Vec3 Connection::damp(std::size_t s, const Now& at) const noexcept {
  const double rate = -power(strands_[s], at.u);
  return left_[s] * std::max(strands_[s].c * rate, -strands_[s].k * at.longer) * at.u;
}

double Connection::due() const noexcept {
  double power_now = 0;
  for (std::size_t s = 0; s < strands_.size(); ++s)
    if (!damping_[s].isZero(0)) power_now += power(strands_[s], damping_[s]);
  return -0.5 * dt_before_ * power_now;
}

void Connection::find_forces(double dt) noexcept {
  on_from_.clear();
  on_to_.clear();
  watched_viscous_ = viscous_ = viscous();
  watched_ = pull_ = 0;
  const auto pull = [&](const Strand& strand, const Vec3& force) {
    pull_ += force.norm();
    put(strand, force, -force);
  };
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    damping_[s].setZero();
    if (!holds(s)) continue;
    const Now at = now(s);
    if (at.longer <= 0) continue;
    const Strand& strand = strands_[s];
    const double k = left_[s] * strand.k;
    if (at.longer < strand.most_longer) {
      const Vec3 force = k * at.longer * at.u;
      watched_ += 0.5 * k * at.longer * at.longer + 0.5 * dt * power(strand, force);
      if (strand.c > 0) {
        damping_[s] = damp(s, at);
        viscous_ -= 0.5 * dt * power(strand, damping_[s]);
      }
      pull(strand, force + damping_[s]);
      continue;
    }
    double w = inverse_mass_of_node(strand);
    for (std::size_t c = 0; c < 3; ++c)
      w += strand.share[c] * strand.share[c] * inverse_mass_of_foot(strand, c);
    const Tear tear = tear_of(strand, k, at.longer, -power(strand, at.u), w, dt_before_);
    left_[s] = 0;
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

void Connection::kick(std::span<const StrandPush> pushes, double dt) noexcept {
  if (pushes.empty()) return;
  on_from_.clear();
  on_to_.clear();
  for (const StrandPush& push : pushes)
    put(strands_[push.strand], (1 - push.at) * push.force, push.at * push.force);
  from_->kick(on_from_, dt);
  to_->kick(on_to_, dt);
}

double Connection::power(std::span<const StrandPush> pushes) const noexcept {
  double sum = 0;
  for (const StrandPush& push : pushes) {
    const Ends v = velocities(strands_[push.strand]);
    sum += push.force.dot((1 - push.at) * v.node + push.at * v.foot);
  }
  return sum;
}

double Connection::cut(std::span<const StrandPush> pushes) noexcept {
  double released = 0;
  for (const StrandPush& push : pushes) {
    double& left = left_[push.strand];
    const double cut = std::min(push.cuts, left);
    if (cut <= 0) continue;
    released += cut * energy(push.strand);
    left -= cut;
    if (left <= 0) ++n_cut_;
  }
  broken_ += released;
  return released;
}

/// As the leapfrog has it.
double Connection::energy(std::size_t s) const noexcept {
  const Now at = now(s);
  const Strand& strand = strands_[s];
  const Vec3 force = strand.k * at.longer * at.u;
  return 0.5 * strand.k * at.longer * at.longer + 0.5 * dt_before_ * power(strand, force);
}

double Connection::stored_by_share(std::size_t strand) const noexcept {
  return std::max(0.0, energy(strand));
}

double Connection::energy() const noexcept {
  double sum = 0;
  for (std::size_t s = 0; s < strands_.size(); ++s)
    if (holds(s)) sum += left_[s] * energy(s);
  return sum;
}

void Connection::save(bool good) noexcept { note(saved_.next(good)); }

void Connection::note(Left& to) const noexcept {
  std::ranges::copy(left_, to.of.begin());
  to.broken = broken_, to.viscous = viscous(), to.n_torn = n_torn_, to.n_cut = n_cut_;
}

void Connection::restore() noexcept { bring_back(saved_.good()); }

void Connection::return_to_mark() noexcept {
  bring_back(marked_);
  watched_ = watched_viscous_ = pull_ = 0;
  take_feet();
  save(false);
  save(true);
}

void Connection::bring_back(const Left& from) noexcept {
  std::ranges::copy(from.of, left_.begin());
  broken_ = from.broken, viscous_ = from.viscous, n_torn_ = from.n_torn, n_cut_ = from.n_cut;
  std::ranges::fill(damping_, Vec3::Zero());
  dt_before_ = 0;
}

void Connection::reset() noexcept {
  std::ranges::fill(left_, 1.0);
  std::ranges::fill(damping_, Vec3::Zero());
  watched_ = watched_viscous_ = broken_ = viscous_ = pull_ = dt_before_ = 0;
  n_torn_ = n_cut_ = 0;
  take_feet();
  save(false);
  save(true);
}

std::uint64_t Connection::hash(std::uint64_t seed) const noexcept {
  return hash_state(left_.data(), left_.size(), seed);
}

}  // namespace palpate::physics
