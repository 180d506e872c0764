#include "physics_node/contact/needle_channel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::physics {
namespace {

constexpr double held_by =
    20;  // k over K. Why: as of a blade, so that the hand's own spring is what the hand feels
constexpr double of_reach =
    0.5;  // Why: so that the balls of two places overlap, and a shaft is held alike all along it
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

/// Where all is, and which of it the shaft has come to. A place answers for the shaft from there to the next, or to
/// the tip.
void NeedleChannel::find_places(const Vec3& along) noexcept {
  front_.x = front_.place.rest + tissue_.displacement(front_.by);
  for (std::size_t n = 0; n < n_places_; ++n) {
    Held& held = places_[n];
    held.x = held.place.rest + tissue_.displacement(held.by);
    held.force.setZero();
    const double behind = (tip_ - held.x).dot(along);
    const bool in = behind > 0 && behind < needle_.length;
    if (in && !held.in) held.slider = behind;
    held.in = in;
    const Vec3& next = n + 1 < n_places_ ? places_[n + 1].place.rest : front_.place.rest;
    held.length = held.last || held.torn ? 0 : std::clamp(behind, 0.0, (next - held.place.rest).norm());
  }
  hub_ = n_places_ > 0 && (tip_ - places_[0].x).dot(along) >= needle_.length;
  front_.force.setZero();
  front_.length = needle_.diameter;
  if (end_ != End::surface && end_ != End::tissue) return;
  resistance_ = tissue_.law(front_.place).cut_toughness * needle_.diameter;
  if (end_ == End::surface) return;
  to_rest_ = tissue_.gradient(front_.place.rest).inverse();
  if (const double stretch = (to_rest_ * along).norm(); std::isfinite(stretch)) resistance_ *= stretch;
}

NearNeedle NeedleChannel::near(const ElementLaw& law) const noexcept {
  return {.modulus = law.modulus,
          .poisson_ratio = tissue_.poisson_ratio(),
          .radius = 0.5 * needle_.diameter,
          .reach = tissue_.reach()};
}

/// k of all that is held. Not stiffer than a multiple of the hand's spring, which is all the same to the hand.
void NeedleChannel::find_holds(const Vec3& along, double stiffness) noexcept {
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
    // What it does not stand before any more it lets go of gradually, as the tip is drawn back.
    if (end_ == End::tissue) held.across *= std::clamp(1 + (tip_ - front_.x).dot(along) / apart_, 0.0, 1.0);
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

/// Across, on tissue [N]. What would be more takes its place along.
Vec3 NeedleChannel::press_aside(Held& held, const Vec3& along, double most, NeedleOutcome& done) noexcept {
  if (!(most > 0)) return Vec3::Zero();  // no shaft is there yet: nothing to take along
  const Vec3 asked = held.across * aside(tip_ - held.x, along);
  const double size = asked.norm();
  if (!(size > most)) return asked;
  const Vec3 way = (1 - most / size) / held.across * asked;
  const Vec3 rest = held.place.rest + tissue_.gradient(held.place.rest).inverse() * way;
  if (const auto place = tissue_.find(rest, skin_beyond)) {
    put(held, *place);
    done.area += held.length * way.norm();
    done.work += most * way.norm();
  } else if (way.norm() > tissue_.reach() && !tissue_.is_rigid(rest)) {
    held.torn = true;
    return Vec3::Zero();
  }
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
    held.force =
        rubs * along + press_aside(held, along, law.puncture_ratio * law.cut_toughness * held.length, done);
  }
  if (!has_end()) return;
  const double ahead = std::clamp(front_.along * (tip_ - front_.x).dot(along), 0.0, most_ahead());
  const double across =
      end_ == End::rigid ? infinite : tissue_.law(front_.place).puncture_ratio * resistance_;
  front_.force = ahead * along + press_aside(front_, along, across, done);
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
    find_holds(along, stiffness);
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
      done.held += held.across;
    });
    go_on(along, done);
    draw_back(along);
  }
  if (end_ == End::nowhere || end_ == End::beyond) meet_surface(entry, before, along);
  return done;
}

}  // namespace palpate::physics
