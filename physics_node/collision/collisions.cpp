#include "physics_node/collision/collisions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/scene/surroundings_spec.h"
#include "physics_node/collision/common_motion.h"
#include "physics_node/collision/passages.h"

namespace palpate::physics {
namespace {

std::vector<ContactBody> contact_bodies(const BodyModels& bodies,
                                        const std::vector<std::unique_ptr<Fragments>>& fragments,
                                        bool with_facets, bool with_front) {
  std::vector<ContactBody> made;
  made.reserve(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    made.emplace_back(*bodies[b], with_facets, with_front, fragments[b].get());
  return made;
}

std::vector<BodyModel*> pointers(const BodyModels& bodies) {
  std::vector<BodyModel*> made;
  for (const auto& body : bodies) made.push_back(body.get());
  return made;
}

constexpr int frames_between_looks = 20;  // whether near bodies are still near
constexpr double speed_margin = 1.25;     // of what a mass may gain within a frame
constexpr double quarter = 0.25;          // of L, in a step
// Of L, in a step or frame: what is slower is never looked at for what it has in common, which is found from all candidates.
constexpr double hardly = 0.02;

}  // namespace

Collisions::Collisions(const BodyModels& bodies, const std::vector<std::unique_ptr<Fragments>>& fragments,
                       const ContactSpec& spec)
    : spec_(spec),
      swept_(spec.distance == ContactDistance::swept),
      moving_(pointers(bodies)),
      pushes_(bodies.size()),
      bodies_(contact_bodies(bodies, fragments, swept_ || spec.count_passages, swept_)),
      near_(bodies_,
            swept_                ? PairKind::facets
            : spec.count_passages ? PairKind::both
                                  : PairKind::masses,
            bodies.front()->pending() != nullptr),
      impulses_(bodies_),
      apart_(bodies.size() * bodies.size(), 0.0),
      stays_near_(bodies.size() * bodies.size(), 0),
      smallest_L_(std::numeric_limits<double>::infinity()) {
  for (const auto& body : bodies) body->prepare_for(Disturbance::impulses);
  if (swept_) swept_contact_ = std::make_unique<SweptContact>(bodies_, near_.most_facets());
  if (bodies.front()->pending() != nullptr)
    joint_contact_ = std::make_unique<JointContact>(bodies_, near_.most_pairs());
  for (const auto& body : bodies_) smallest_L_ = std::min(smallest_L_, body.candidates().length());
}

std::size_t Collisions::n_candidates() const noexcept {
  std::size_t n = 0;
  for (const auto& body : bodies_) n += body.candidates().size();
  return n;
}

/// No mass of it moves faster in the coming frame.
double Collisions::fastest(std::uint32_t b) const noexcept {
  return speed_margin *
         std::max(bodies_[b].speed() + bodies_[b].common_velocity().norm(), moving_[b]->watch().speed);
}

/// The same against what bodies do as wholes, with what that is of two against each other, as candidates
/// were when all were read last.
double Collisions::fastest_apart(std::uint32_t b) const noexcept {
  return go_together() ? speed_margin * (bodies_[b].speed() + closing()) : fastest(b);
}

/// How fast any two bodies that are near move against each other as wholes. [m/s]
double Collisions::closing() const noexcept {
  double most = 0;
  for (const Link& link : near_.links())
    if (link.near)
      most = std::max(most, (bodies_[link.a].common_velocity() - bodies_[link.b].common_velocity()).norm());
  return most;
}

bool Collisions::are_near(std::uint32_t a, std::uint32_t b, double frame_seconds) noexcept {
  const auto travel = [&] { return frame_seconds * (fastest(a) + fastest(b)) + 0.01 * smallest_L_; };
  double& apart = apart_[a * bodies_.size() + b];
  int& stays_near = stays_near_[a * bodies_.size() + b];
  if (stays_near > 0) return --stays_near, true;
  apart -= travel();
  if (apart > 0) return false;
  bodies_[a].refresh(0);  // how fast, before how far: at the start nobody has looked yet
  bodies_[b].refresh(0);
  // Twice the distance at which masses touch, so that the list of pairs is there before they do.
  const double reach = 2 * std::max(bodies_[a].candidates().length(), bodies_[b].candidates().length());
  apart = gap_between(bodies_[a].box(), bodies_[b].box()) - reach - travel();
  stays_near = apart <= 0 ? frames_between_looks : 0;
  return apart <= 0;
}

bool Collisions::begin_frame(double frame_seconds) noexcept {
  bool any_near = false;
  bodies_near_ = false;
  fastest_ = 0;
  const auto n = static_cast<std::uint32_t>(bodies_.size());
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a; b < n; ++b) {
      const bool near = a == b ? bodies_[a].touches_itself() : are_near(a, b, frame_seconds);
      near_.allow(a, b, near);
      if (!near) continue;
      any_near = true;
      bodies_near_ = bodies_near_ || a != b;
      fastest_ = std::max({fastest_, fastest_apart(a), fastest_apart(b)});
    }
  if (!any_near)
    go_with_common(std::numeric_limits<double>::infinity());
  else if (fastest_ * frame_seconds > quarter * smallest_L_)
    read_all(0, frame_seconds);
  plan_for(fastest_);
  if (!any_near && joint_contact_) joint_contact_->restart();
  return any_near;
}

void Collisions::plan_for(double speed) noexcept {
  planned_for_ = speed;
  wanted_step_ =
      swept_ && speed > 0 ? quarter * smallest_L_ / speed : std::numeric_limits<double>::infinity();
}

/// @param least  what is slower does not count as a motion of the whole [m/s]
void Collisions::go_with_common(double least) noexcept {
  bool any = false;
  const Vec3 usual = std::isinf(least) ? Vec3::Zero() : usual_velocity(bodies_, least);
  for (auto& body : bodies_) {
    const Vec3 velocity = std::isinf(least) ? Vec3::Zero() : common_velocity(body, usual, least);
    any = any || !velocity.isZero(0);
    if (velocity != body.common_velocity()) body.go_with(velocity);
  }
  if (!any && !go_together()) return;
  go_together_ = any;
  fastest_ = 0;
  for (const auto& body : bodies_) fastest_ = std::max(fastest_, speed_margin * body.speed());
  fastest_ += speed_margin * closing();
}

/// And finds what each body does as a whole, if that is worth it in a time. @return false: some number is
/// not finite
bool Collisions::read_all(double dt, double seconds) noexcept {
  bool finite = true;
  for (auto& body : bodies_) finite = body.refresh(dt) && finite;
  if (finite) go_with_common(hardly * smallest_L_ / seconds);
  return finite;
}

void Collisions::end_step(double dt) noexcept {
  for (auto& body : bodies_) body.end_step(dt);
}

bool Collisions::read_where_they_are(double dt) noexcept {
  bool finite = true;
  // Those that were read tell when something has become faster than the frame began with.
  for (std::uint32_t b = 0; b < bodies_.size(); ++b)
    fastest_ = std::max(fastest_, speed_margin * bodies_[b].speed());
  for (const Link& link : near_.links()) {
    const double speed = std::max(bodies_[link.a].speed(), bodies_[link.b].speed()) + link.closing;
    if (link.near && speed > planned_for_) plan_for(speed_margin * speed);
  }
  // Why all where they go together: what stops for something outside leaves the others at once.
  if (go_together() || near_.needs_all(bodies_, fastest_, dt)) {
    finite = read_all(dt, dt);
    if (finite) near_.update(bodies_, dt);
  } else {
    for (auto& body : bodies_) finite = body.refresh_listed(dt) && finite;
    near_.follow(bodies_);
  }
  return finite;
}

void Collisions::follow_breaks() noexcept {
  for (auto& body : bodies_) body.follow_breaks();
}

CollisionWork Collisions::step(double dt) noexcept {
  CollisionWork work;
  if (!read_where_they_are(dt)) return work;  // not finite: the guard's
  end_step(dt);
  tally_.rebuilds = near_.rebuilds();
  tally_.overflows = near_.overflows() + active_overflows_;
  if (near_.size() == 0) return work;
  impulses_.begin_step();
  if (swept_) {
    const SweptReport report = swept_contact_->step(bodies_, near_, spec_.restitution, dt, impulses_);
    tally_.collisions += report.collisions;
    tally_.stopped += report.stopped;
    active_overflows_ += report.overflows;
    work.lost = report.lost;
  } else {
    for (const Link& link : near_.links()) {
      const ExchangeReport report =
          exchange_velocities(bodies_, link.masses.pairs(), spec_.restitution, impulses_);
      tally_.collisions += report.collisions;
      work.lost += report.lost;
    }
  }
  if (spec_.count_passages)
    for (const Link& link : near_.links())
      tally_.passages += count_passages(bodies_, link.facets.pairs(), dt, impulses_);
  work.driven = impulses_.driven_work();
  give_impulses(dt);
  return work;
}

bool Collisions::solve(const ExplicitStep& step, std::span<const std::vector<NodalForce>> tools) noexcept {
  const auto solve_all = [&] {
    for (std::size_t b = 0; b < moving_.size(); ++b)
      moving_[b]->pending()->solve(step, {tools[b], contact(b)});
  };
  const bool finite = read_where_they_are(step.dt);  // before it is solved: where it begins
  tally_.rebuilds = near_.rebuilds();
  if (finite)
    joint_contact_->begin(bodies_, near_.links(), step.dt);
  else
    joint_contact_->restart();  // the guard's
  solve_all();
  for (bool better = finite; better;) {
    for (auto& body : bodies_) body.refresh_listed(step.dt);
    better = joint_contact_->improve(bodies_, step.dt);
    if (better) solve_all();
  }
  impulses_.begin_step();
  const JointReport report = joint_contact_->end(bodies_, step.dt, impulses_);
  end_step(step.dt);
  tally_.collisions += report.touching;
  active_overflows_ += report.overflows;
  tally_.overflows = near_.overflows() + active_overflows_;
  return report.converged;
}

void Collisions::give_impulses(double dt) noexcept {
  impulses_.for_each([&](PairEnd at, const Vec3& dv) {
    pushes_[at.body].add(*moving_[at.body], {bodies_[at.body].candidates().cell()[at.n], dv}, dt);
  });
  for (std::size_t b = 0; b < pushes_.size(); ++b) pushes_[b].give(*moving_[b], dt);
}

void Collisions::restart() noexcept {
  for (auto& body : bodies_) body.restart();
  near_.restart();
  go_with_common(std::numeric_limits<double>::infinity());
  if (joint_contact_) joint_contact_->restart();
  if (swept_contact_) swept_contact_->restart();
  std::fill(apart_.begin(), apart_.end(), 0.0);
  std::fill(stays_near_.begin(), stays_near_.end(), 0);
  for (std::size_t b = 0; b < bodies_.size(); ++b) impulses_.take(static_cast<std::uint32_t>(b));
}

}  // namespace palpate::physics
