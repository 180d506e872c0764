// Where a needle's channel begins, goes on and ends.

#include <algorithm>
#include <cmath>

#include "physics_node/contact/needle_channel.h"

namespace palpate::physics {
namespace {

constexpr double most_on = 0.5;  // spacings that a tip goes on in a step, whatever lets go of it

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
}

/// The shaft is going to hold it, too, where the end is now.
NeedleChannel::Held& NeedleChannel::keep_front() noexcept {
  Held& held = places_[n_places_++];
  held = front_;
  held.force.setZero();
  held.in = held.last = false;
  return held;
}

/// The end of the channel goes on where the tip presses more than tissue bears.
void NeedleChannel::go_on(const Vec3& along, NeedleOutcome& done) noexcept {
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
  const bool stops = !place && tissue_.is_rigid(rest);
  if (stops || n_places_ == most_places) {
    end_ = End::rigid;
    return;
  }
  done.area += needle_.diameter * way.norm();
  done.work += resistance_ * on;
  if (!place) {
    end_ = End::beyond;
    keep_front().last = true;
    return;
  }
  put(front_, *place);
  if ((front_.place.rest - places_[n_places_ - 1].place.rest).norm() < apart_) return;
  keep_front();
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
