#include "physics_node/collision/collisions.h"

#include <algorithm>
#include <limits>

#include "physics_node/collision/passages.h"

namespace palpate::physics {
namespace {

std::vector<ContactBody> contact_bodies(const std::vector<std::unique_ptr<MovingBody>>& bodies,
                                        bool with_facets, bool with_front) {
  std::vector<ContactBody> made;
  made.reserve(bodies.size());
  for (const auto& body : bodies) made.emplace_back(*body, with_facets, with_front);
  return made;
}

std::vector<MovingBody*> pointers(const std::vector<std::unique_ptr<MovingBody>>& bodies) {
  std::vector<MovingBody*> made;
  for (const auto& body : bodies) made.push_back(body.get());
  return made;
}

constexpr double speed_margin = 1.25;  // of what a body may gain within a frame

}  // namespace

Collisions::Collisions(const std::vector<std::unique_ptr<MovingBody>>& bodies, const ContactSpec& spec)
    : spec_(spec),
      swept_(spec.distance == ContactDistance::swept),
      moving_(pointers(bodies)),
      bodies_(contact_bodies(bodies, swept_ || spec.count_passages, swept_)),
      near_(bodies_, swept_                ? PairKind::facets
                     : spec.count_passages ? PairKind::both
                                           : PairKind::masses),
      impulses_(bodies_),
      apart_(bodies.size() * bodies.size(), 0.0),
      smallest_L_(std::numeric_limits<double>::infinity()) {
  for (const auto& body : bodies) body->prepare_contact();
  if (swept_) swept_contact_ = std::make_unique<SweptContact>(bodies_, near_.facets().capacity());
  for (const auto& body : bodies_) smallest_L_ = std::min(smallest_L_, body.candidates().length());
}

std::size_t Collisions::n_candidates() const noexcept {
  std::size_t n = 0;
  for (const auto& body : bodies_) n += body.candidates().size();
  return n;
}

bool Collisions::are_near(std::uint32_t a, std::uint32_t b, double frame_seconds) noexcept {
  // Inner masses may be faster than the candidates, and come out where elements break.
  const auto travel = [&] {
    const double speed = std::max(bodies_[a].speed(), moving_[a]->watch().speed) +
                         std::max(bodies_[b].speed(), moving_[b]->watch().speed);
    return speed_margin * frame_seconds * speed + 0.01 * smallest_L_;
  };
  double& apart = apart_[a * bodies_.size() + b];
  apart -= travel();
  if (apart > 0) return false;
  bodies_[a].refresh(0);  // how fast, before how far: at the start nobody has looked yet
  bodies_[b].refresh(0);
  // Twice the distance at which masses touch, so that the list of pairs is there before they do.
  const double reach = 2 * std::max(bodies_[a].candidates().length(), bodies_[b].candidates().length());
  apart = gap_between(bodies_[a].box(), bodies_[b].box()) - reach - travel();
  return apart <= 0;
}

bool Collisions::begin_frame(double frame_seconds) noexcept {
  bool any_near = false;
  double fastest = 0;
  const auto n = static_cast<std::uint32_t>(bodies_.size());
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a; b < n; ++b) {
      const bool near = a == b ? bodies_[a].touches_itself() : are_near(a, b, frame_seconds);
      near_.allow(a, b, near);
      if (!near) continue;
      any_near = true;
      if (a == b) bodies_[a].refresh(0);
      fastest = std::max({fastest, bodies_[a].speed(), bodies_[b].speed()});
    }
  wanted_step_ = swept_ && fastest > 0 ? 0.25 * smallest_L_ / (speed_margin * fastest)
                                       : std::numeric_limits<double>::infinity();
  return any_near;
}

void Collisions::follow_breaks() noexcept {
  for (auto& body : bodies_) changed_ = body.follow_breaks() || changed_;
}

void Collisions::step(double dt) noexcept {
  for (auto& body : bodies_)
    if (!body.refresh(dt)) return;  // not finite: the guard's
  near_.update(bodies_, changed_, dt);
  changed_ = false;
  tally_.rebuilds = near_.rebuilds();
  tally_.overflows = near_.overflows() + active_overflows_;
  if (near_.masses().empty() && near_.facets().empty()) return;
  impulses_.begin_step();
  if (swept_) {
    const SweptReport report =
        swept_contact_->step(bodies_, near_.facets(), spec_.restitution, dt, impulses_);
    tally_.collisions += report.collisions;
    tally_.stopped += report.stopped;
    active_overflows_ += report.overflows;
    tally_.lost += report.lost;
  } else {
    const ExchangeReport report = exchange_velocities(bodies_, near_.masses(), spec_.restitution, impulses_);
    tally_.collisions += report.collisions;
    tally_.lost += report.lost;
  }
  if (spec_.count_passages) tally_.passages += count_passages(bodies_, near_.facets(), dt, impulses_);
  tally_.driven_work += impulses_.driven_work();
  give_impulses(dt);
}

void Collisions::give_impulses(double dt) noexcept {
  impulses_.for_each([&](PairEnd at, const Vec3& dv) {
    moving_[at.body]->push(bodies_[at.body].candidates().cell()[at.n], dv, dt);
  });
}

void Collisions::restart() noexcept {
  for (auto& body : bodies_) body.restart();
  std::fill(apart_.begin(), apart_.end(), 0.0);
  changed_ = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) impulses_.take(static_cast<std::uint32_t>(b));
}

}  // namespace palpate::physics
