// Where a needle's channel begins, goes on and ends.

#include <algorithm>
#include <cmath>

#include "physics_node/contact/needle_channel.h"

namespace palpate::physics {
namespace {

constexpr std::size_t for_walls = 16;  // places that are kept for them
constexpr double most_on = 0.5;        // spacings that a tip goes on in a step, whatever lets go of it

}  // namespace

/// Its velocity stays that with which this step takes a force.
void NeedleChannel::put(Held& held, const PiercedTissue::Place& place) const noexcept {
  held.place = place;
  tissue_.gather(place.rest, held.by);
  held.x = place.rest + tissue_.displacement(held.by);
}

/// A channel that ends here, at a surface.
void NeedleChannel::begin_at(const PiercedTissue::Place& place) noexcept {
  front_.place = place;
  front_.by.clear();
  front_.x = place.rest, front_.v.setZero();
  if (place.cell >= 0) put(front_, place), front_.v = tissue_.velocity(front_.by);
  front_.force.setZero();
  front_.torn = false;
  entry_ = n_places_;
  before_it_ = 1;
}

/// Beside its channel from the place numbered n on, which it forgets: the end is where the tip is, and the place before
/// answers for the shaft up to there.
void NeedleChannel::leave_at(std::size_t n, const Vec3& rest, const Vec3& along) noexcept {
  n_places_ = n;
  if (n > 0) places_[n - 1].room = std::clamp((tip_ - places_[n - 1].x).dot(along), 0.0, places_[n - 1].room);
  const auto place = tissue_.find(rest, skin_beyond);
  if (!place) {
    end_ = End::beyond;
    if (n > 0) places_[n - 1].last = true;
    return;
  }
  put(front_, *place);
  front_.v = tissue_.velocity(front_.by);
  front_.torn = false;
  end_ = End::tissue;
  before_it_ = 1;
  in_a_cell_ = false;
  to_rest_ = tissue_.to_rest(rest);
  keep_front();
}

/// On a surface that falls away beside the tip it follows that, a spacing deep at most.
bool NeedleChannel::slide_on_surface(Held& held, const Vec3& rest, const Vec3& along) noexcept {
  if (&held != &front_ || end_ != End::surface) return false;
  for (double deep = 1.0 / 16; deep <= 1; deep *= 2)
    if (const auto place = tissue_.find(rest + deep * tissue_.spacing() * along, skin_beyond)) {
      put(held, *place);
      return true;
    }
  return false;
}

/// The shaft is going to hold it, too, where the end is now: so far by no length.
NeedleChannel::Held& NeedleChannel::keep_front() noexcept {
  Held& held = places_[n_places_++];
  held = front_;
  held.force.setZero();
  held.in = true, held.last = false;
  held.length = held.room = 0;
  held.slider = 0;
  return held;
}

/// The end of the channel goes on where the tip presses more than tissue bears.
void NeedleChannel::go_on(const Vec3& along, NeedleOutcome& done) noexcept {
  if (end_ == End::rigid && front_.slips && front_.place.cell >= 0)
    end_ = End::tissue;  // until bone is ahead again
  if (end_ != End::surface && end_ != End::tissue) return;
  const double most = most_ahead(), asked = front_.along * (tip_ - front_.x).dot(along);
  if (!(asked > most) || !(front_.along > 0)) return;
  if (end_ == End::surface) {
    if (n_places_ == most_places) return;
    end_ = End::tissue;
    entry_ = n_places_;
    keep_front();
    in_a_cell_ = false;
    done.entered = true;
    return;  // and goes on in the next step, for which it pays T
  }
  const double on = std::min((asked - most) / front_.along, most_on * tissue_.spacing());
  const Vec3 way = to_rest_ * (on * along), rest = front_.place.rest + way;
  const auto inside = tissue_.find(rest);
  in_a_cell_ = in_a_cell_ || inside;
  const auto place = in_a_cell_ ? inside : tissue_.find(rest, skin_beyond);
  if (!place && tissue_.is_rigid(rest)) {
    end_ = End::rigid;
    return;
  }
  done.work += resistance_ * on;
  done.area += resistance_ * on / tissue_.law(front_.place).cut_toughness;
  if (!place) {
    end_ = End::beyond;
    if (n_places_ < most_places) keep_front();
    places_[n_places_ - 1].last = true;
    return;
  }
  put(front_, *place);
  // By the way along: what has been led aside needs no more places.
  double& room = places_[n_places_ - 1].room;
  room += way.norm();
  if (n_places_ + for_walls < most_places && room >= apart_) keep_front();
}

/// Out of what it has pierced last, or off the surface that it has only pressed.
void NeedleChannel::draw_back(const Vec3& along) noexcept {
  // Led out of the side of what it was in.
  if (front_.torn) end_ = n_places_ > 0 ? End::beyond : End::nowhere;
  if (n_places_ > 0 && std::ranges::all_of(places(), &Held::torn) && !has_end()) return let_go();
  const auto is_out = [&](const Held& held) { return (tip_ - held.x).dot(along) < 0; };
  // What is rigid inside tissue stands at the end of a channel, and is left with it.
  const bool pressed_only = end_ == End::surface || (end_ == End::rigid && entry_ == n_places_);
  if (pressed_only && is_out(front_)) end_ = End::nowhere;
  if (end_ == End::rigid && is_out(front_)) end_ = End::tissue;
  if (end_ != End::nowhere && entry_ < n_places_ && is_out(places_[entry_])) {
    n_places_ = entry_;
    end_ = End::nowhere;
  }
  if (end_ != End::nowhere || n_places_ == 0) return;
  // There is another channel behind, which it has come out of.
  end_ = End::beyond;
  front_ = places_[n_places_ - 1];
  entry_ = n_places_ - 1;
  while (entry_ > 0 && !places_[entry_ - 1].last) --entry_;
}

/// Out of a wall it enters only what it goes toward: not, drawn back, where it came out.
void NeedleChannel::meet_surface(const TipEntry& entry, const Vec3& before, const Vec3& along) noexcept {
  const auto through = entry.come_through(before, tip_);
  if (!through) return;
  if (end_ == End::beyond && through->out.dot(along) >= 0) return;
  if (through->rigid) {
    begin_at({.rest = through->rest});
    end_ = End::rigid;
    return;
  }
  const auto place = tissue_.find(through->rest, skin_beyond);
  if (!place) return;
  begin_at(*place);
  end_ = End::surface;
}

}  // namespace palpate::physics
