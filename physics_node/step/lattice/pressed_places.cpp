#include "physics_node/step/lattice/pressed_places.h"

#include <algorithm>
#include <limits>

namespace palpate::physics {
namespace {

// Why: tissue that is let go has swung out by then, and what is left is booked as lost.
constexpr double forgotten_after = 0.5;  // [s]

}  // namespace

PressedPlaces::PressedPlaces(double apart) : apart_(apart) {
  places_.reserve(most);
  noted_.reserve(most);
}

bool PressedPlaces::note(const Vec3& at, const Vec3& push) noexcept {
  const double force = push.norm();
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < places_.size(); ++p)
    if (const double away = (places_[p].at - at).squaredNorm(); away < least) nearest = p, least = away;
  const bool fresh = least > apart_ * apart_ && places_.size() < most;
  if (fresh) {
    nearest = places_.size();
    places_.push_back({at});
    noted_.emplace_back();
  }
  noted_[nearest].force += force;
  noted_[nearest].moment += force * at;
  noted_[nearest].push += push;
  return fresh;
}

void PressedPlaces::look(double seconds) noexcept {
  for (std::size_t p = 0; p < places_.size(); ++p) {
    PressedPlace& place = places_[p];
    if (noted_[p].force > 0) {
      place = {noted_[p].moment / noted_[p].force, noted_[p].force, noted_[p].push};
    } else if (seconds > 0) {
      place.weight = 0;
      place.idle += seconds;
    }
    noted_[p] = {};
  }
  const auto weaker = [](const PressedPlace& a, const PressedPlace& b) { return a.weight < b.weight; };
  const auto has_met_another = [&](std::size_t p) {
    for (std::size_t q = 0; q < places_.size(); ++q) {
      const bool yields = weaker(places_[p], places_[q]) || (!weaker(places_[q], places_[p]) && q < p);
      if (q != p && yields && (places_[p].at - places_[q].at).norm() < 0.5 * apart_) return true;
    }
    return false;
  };
  for (std::size_t p = places_.size(); p-- > 0;) {
    if (places_[p].idle < forgotten_after && !has_met_another(p)) continue;
    places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(p));
    noted_.pop_back();
  }
}

void PressedPlaces::clear() noexcept {
  places_.clear();
  noted_.clear();
}

}  // namespace palpate::physics
