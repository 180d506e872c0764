#include "physics_node/contact/needle_channel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palpate::physics {
namespace {

constexpr double held_by =
    20;  // k over K. Why: as of a blade, so that the hand's own spring is what the hand feels
constexpr double of_reach =
    0.5;  // Why: so that the balls of two places overlap, and a shaft is held alike all along it
constexpr double about_to_enter =
    0.1;  // Why: a tip that is pressed straight on does not slip where it will enter
constexpr double on_bone =
    0.3;  // Coulomb's, of a tip that slides. Why: between those of wet and dry bone on steel
constexpr double infinite = std::numeric_limits<double>::infinity();

Vec3 aside(const Vec3& v, const Vec3& along) noexcept { return v - along.dot(v) * along; }

}  // namespace

NeedleChannel::NeedleChannel(const BodyModel& body, const NeedleSpec& needle)
    : tissue_(body, needle.diameter),
      needle_(needle),
      apart_(std::max(of_reach * tissue_.reach(), 2 * needle.length / static_cast<double>(most_places))),
      pull_(static_cast<std::size_t>(body.body().capacity()), 0.0) {
  places_.resize(most_places);
  for (Held& held : places_) held.by.reserve(PiercedTissue::most_carriers);
  front_.by.reserve(PiercedTissue::most_carriers);
  forces_.reserve((most_places + 1) * PiercedTissue::most_carriers);
}

double NeedleChannel::depth() const noexcept {
  double sum = 0;
  for (const Held& held : places())
    if (held.in) sum += held.length;
  return sum;
}

void NeedleChannel::let_go() noexcept {
  n_places_ = 0;
  forces_.clear();
  end_ = End::nowhere;
  entry_ = 0;
  off_.setZero();
  seen_ = false;
}

void NeedleChannel::begin_step() noexcept {
  if (!holds()) return;
  const bool copied = tissue_.copies() != copies_;
  copies_ = tissue_.copies();
  const auto begin = [&](Held& held) {
    if (copied && held.place.cell >= 0) tissue_.gather(held.place.rest, held.by);
    held.v = tissue_.velocity(held.by);
  };
  for (Held& held : places()) begin(held);
  begin(front_);
}

/// r of the shaft's hold, where more of it has come: (b - x) -> r (b - x), along and across.
void NeedleChannel::take_in(Held& held, double before, double now, const Eigen::Matrix3d& to_rest,
                            const Vec3& along) noexcept {
  if (!(now > before)) return;
  const double part = 1 - before / now;
  if (&held != &front_) held.slider += part * ((tip_ - held.x).dot(along) - held.slider);
  const Vec3 rest = held.place.rest + part * (to_rest * aside(tip_ - held.x, along));
  if (const auto place = tissue_.find(rest, skin_beyond)) put(held, *place);
}

/// Is the tip farther beside it than a channel is wide?
bool NeedleChannel::is_beside(const Held& held, const Vec3& along) const noexcept {
  return aside(tip_ - held.x, along).norm() > needle_.diameter;
}

/// Where the end is, what it resists with, and how much of it holds the tip across: what the tip does not stand before
/// any more it lets go of gradually, as it is drawn back.
void NeedleChannel::find_end(const Vec3& along) noexcept {
  front_.x = front_.place.rest + tissue_.displacement(front_.by);
  front_.force.setZero();
  front_.length = needle_.diameter;
  if (end_ != End::surface && end_ != End::tissue) return;
  const ElementLaw& law = tissue_.law(front_.place);
  resistance_ = law.cut_toughness * needle_.diameter;
  if (end_ == End::surface) return;
  to_rest_ = tissue_.to_rest(front_.place.rest);
  // Why no more than to enter: the more tissue is pressed together before the tip, the more of it there is to part.
  resistance_ *= std::min((to_rest_ * along).norm(), law.puncture_ratio);
  const double before =
      std::exchange(before_it_, std::clamp(1 + (tip_ - front_.x).dot(along) / apart_, 0.0, 1.0));
  if (before == 0 && before_it_ > 0 && is_beside(front_, along))
    leave_at(n_places_, front_.place.rest + to_rest_ * (tip_ - front_.x), along);
  else
    take_in(front_, before, before_it_, to_rest_, along);
}

/// Where all is, and which of it the shaft has come to. A place answers for the shaft from there to the next, or to
/// the tip.
void NeedleChannel::find_places(const Vec3& along) noexcept {
  find_end(along);
  for (std::size_t n = 0; n < n_places_; ++n) {
    Held& held = places_[n];
    held.x = held.place.rest + tissue_.displacement(held.by);
    held.force.setZero();
    const double behind = (tip_ - held.x).dot(along);
    const bool came = !std::exchange(held.in, behind > 0 && behind < needle_.length) && held.in;
    const double before = came ? 0.0 : held.length;
    held.length = held.last || held.torn ? 0 : std::clamp(behind, 0.0, held.room);
    if (!held.in || !(held.length > before)) continue;
    const bool at_the_end = n + 1 == n_places_ && end_ == End::tissue;
    const Eigen::Matrix3d to_rest = at_the_end ? to_rest_ : tissue_.to_rest(held.place.rest);
    if (came && n > entry_ && behind < apart_ && is_beside(held, along)) {
      leave_at(n, held.place.rest + to_rest * (tip_ - held.x), along);
      break;
    }
    take_in(held, before, held.length, to_rest, along);
  }
  hub_ = n_places_ > 0 && (tip_ - places_[0].x).dot(along) >= needle_.length;
}

NearNeedle NeedleChannel::near(const ElementLaw& law) const noexcept {
  return {.modulus = law.modulus,
          .poisson_ratio = tissue_.poisson_ratio(),
          .radius = 0.5 * needle_.diameter,
          .reach = tissue_.reach()};
}

/// k of all that is held. Not stiffer than a multiple of the hand's spring, which is all the same to the hand.
void NeedleChannel::find_holds(double stiffness) noexcept {
  const double most = held_by * stiffness;
  each_held([&](Held& held) {
    held.along = held.across = most;
    if (end_ == End::rigid && &held == &front_) return;
    const ElementLaw& law = tissue_.law(held.place);
    const NearNeedle gives = near(law);
    if (&held != &front_) {
      const double stiffest = most * std::min(1.0, held.length / apart_);
      held.along = 1 / (1 / std::max(stiffest, 1e-9) + gives.along() / std::max(held.length, 1e-12));
      held.across = 1 / (1 / std::max(stiffest, 1e-9) + gives.across() / std::max(held.length, 1e-12));
      return;
    }
    const double enters = law.puncture_ratio * law.cut_toughness * needle_.diameter;
    held.along = held.across = 1 / (1 / most + gives.tip(enters) / enters);
    if (end_ == End::tissue) held.across *= before_it_;
  });
}

/// k / (1 + g)
void NeedleChannel::soften(double Held::*hold, double dt) noexcept {
  const std::vector<double>& inverse_mass = tissue_.body().body().inverse_mass;
  each_held([&](Held& held) {
    for (const PiercedTissue::Carrier& one : held.by)
      pull_[static_cast<std::size_t>(one.node)] += one.weight * held.*hold;
  });
  each_held([&](Held& held) {
    double g = 0;
    for (const PiercedTissue::Carrier& one : held.by) {
      const auto node = static_cast<std::size_t>(one.node);
      g += one.weight * inverse_mass[node] * pull_[node];
    }
    held.*hold /= 1 + dt * dt * g;
  });
  each_held([&](Held& held) {
    for (const PiercedTissue::Carrier& one : held.by) pull_[static_cast<std::size_t>(one.node)] = 0;
  });
}

/// p T; of what is rigid, and with all of the shaft in tissue, without limit [N].
double NeedleChannel::most_ahead() const noexcept {
  if (end_ == End::rigid || hub_) return infinite;
  return resistance_ * (end_ == End::surface ? tissue_.law(front_.place).puncture_ratio : 1.0);
}

double NeedleChannel::along_at(double lag, const Vec3& hand, const Vec3& along) const noexcept {
  double sum = 0;
  for (const Held& held : places()) {
    if (!held.in) continue;
    const double most = needle_.friction * held.length;
    sum += std::clamp(held.along * (lag - held.slider - (held.x - hand).dot(along)), -most, most);
  }
  if (has_end()) sum += std::clamp(front_.along * (lag - (front_.x - hand).dot(along)), 0.0, most_ahead());
  return sum;
}

/// Where tip and hand are in balance: along by halving, as the sum has a corner for each place; across at once.
void NeedleChannel::find_tip(const Vec3& hand, const Vec3& along, double stiffness) noexcept {
  double most = 0, held_across = 0;
  Vec3 across = Vec3::Zero();
  each_held([&](const Held& held) {
    most += &held != &front_ ? needle_.friction * held.length
                             : std::min(most_ahead(), held.along * std::max(0.0, (hand - held.x).dot(along)));
    across += held.across * aside(held.x - hand, along);
    held_across += held.across;
  });
  double low = -most / stiffness, high = most / stiffness;
  for (int n = 0; n < 50 && low < high; ++n) {
    const double middle = 0.5 * (low + high);
    (along_at(middle, hand, along) + stiffness * middle < 0 ? low : high) = middle;
  }
  off_ = 0.5 * (low + high) * along + across / (stiffness + held_across);
  tip_ = hand + off_;
}

/// Across, on tissue [N]. What would be more takes its place along; where no tissue is any more, the shaft comes out.
Vec3 NeedleChannel::press_aside(Held& held, const Vec3& along, double most, NeedleOutcome& done) noexcept {
  held.slips = false;
  if (!(most > 0)) return Vec3::Zero();  // no shaft is there yet
  const Vec3 asked = held.across * aside(tip_ - held.x, along);
  const double size = asked.norm();
  if (!(size > most)) return asked;
  const Vec3 way = (1 - most / size) / held.across * asked;
  if (held.place.cell < 0) {
    held.place.rest += way;
    held.x = held.place.rest;
    done.rubbed += most * way.norm();
  } else {
    const Vec3 rest = held.place.rest + tissue_.to_rest(held.place.rest) * way;
    if (const auto place = tissue_.find(rest, skin_beyond))
      put(held, *place);
    else if (tissue_.is_rigid(rest))
      return asked;
    else if (!slide_on_surface(held, rest, along)) {
      held.torn = true;
      return Vec3::Zero();
    }
    done.area += held.length * way.norm();
    done.work += most * way.norm();
  }
  held.slips = true;
  return most / size * asked;
}

void NeedleChannel::press(const Vec3& along, NeedleOutcome& done) noexcept {
  for (Held& held : places()) {
    if (!held.in) continue;
    const ElementLaw& law = tissue_.law(held.place);
    const double most = needle_.friction * held.length,
                 asked = held.along * ((tip_ - held.x).dot(along) - held.slider);
    const double rubs = std::clamp(asked, -most, most);
    if (held.along > 0) {
      const double slips = (asked - rubs) / held.along;
      held.slider += slips;
      done.rubbed += rubs * slips;
    }
    if (asked == rubs) done.along += held.along;
    held.force =
        rubs * along + press_aside(held, along, law.puncture_ratio * law.cut_toughness * held.length, done);
    if (!held.slips) done.across += held.across;
  }
  if (!has_end()) return;
  const double asked = front_.along * (tip_ - front_.x).dot(along);
  const double ahead = std::clamp(asked, 0.0, most_ahead());
  if (asked == ahead) done.along += front_.along;
  double across =
      front_.place.cell >= 0 ? tissue_.law(front_.place).puncture_ratio * resistance_ : on_bone * ahead;
  if (end_ == End::surface)
    across = std::sqrt(std::max(about_to_enter * across * across, across * across - ahead * ahead));
  front_.force = ahead * along + press_aside(front_, along, across, done);
  if (!front_.slips) done.across += front_.across;
}

NeedleOutcome NeedleChannel::step(const TipEntry& entry, const Vec3& hand, const Vec3& along,
                                  double stiffness, double dt) noexcept {
  NeedleOutcome done;
  forces_.clear();
  if (!holds()) off_.setZero();
  const Vec3 before = seen_ ? tip_ : hand + off_;
  tip_ = hand + off_;
  seen_ = true;
  if (holds()) {
    find_places(along);
    find_holds(stiffness);
    soften(&Held::along, dt);
    soften(&Held::across, dt);
    find_tip(hand, along, stiffness);
    press(along, done);
    each_held([&](const Held& held) {
      for (const PiercedTissue::Carrier& one : held.by)
        forces_.push_back({one.node, one.weight * held.force});
      done.force += held.force;
      done.moment += (held.x - tip_).cross(held.force);
      done.power += held.force.dot(held.v);
    });
    go_on(along, done);
    draw_back(along);
  }
  if (end_ == End::nowhere || end_ == End::beyond) meet_surface(entry, before, along);
  return done;
}

}  // namespace palpate::physics
