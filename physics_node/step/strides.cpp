#include "physics_node/step/strides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace palpate::physics {
namespace {

constexpr double rounding = 1e-9;

// Why: of so many steps one more or less is nothing, and each is looked at.
constexpr int most_looked_at = 1000;

constexpr double in_use =
    1.1;  // as stiff as at rest. Why: tissue that is pulled a little is stiffer by some percent

/// Why no more: stiffness comes and goes, and with it the number of steps.
int most_shared(int n) noexcept { return n + n / 4; }

int multiple(int n, int of) noexcept { return (n + of - 1) / of * of; }

/// Fewest impulses in n steps of dt, each of at most `seconds`.
int fewest(int n, double dt, double seconds) noexcept {
  return static_cast<int>(std::clamp(std::ceil(n * dt / seconds - rounding), 1.0, 1.0 * n));
}

/// And that divide n.
int fewest_alike(int n, double dt, double seconds) noexcept {
  int impulses = fewest(n, dt, seconds);
  while (n % impulses != 0) ++impulses;
  return impulses;
}

}  // namespace

void Strides::add(double seconds, double cost) { of_.push_back({.seconds = seconds, .cost = cost}); }

int Strides::impulses(const Of& body, int n, double frame) noexcept {
  return body.seconds > 0 ? fewest_alike(n, frame / n, body.seconds / in_use) : n;
}

void Strides::share(int n_loaded, double frame) noexcept {
  beat_ = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int n = n_loaded; n <= std::min(most_shared(n_loaded), most_looked_at); ++n) {
    double cost = 0;
    int beat = 1;
    for (const Of& body : of_) {
      const int k = impulses(body, n, frame);
      cost += body.cost * k;
      if (k < n) beat = std::lcm(beat, k);
    }
    if (cost < least) least = cost, beat_ = beat;
  }
}

int Strides::shared(int n) const noexcept {
  const int more = multiple(n, beat_);
  return more <= most_shared(n) ? more : n;
}

void Strides::divide(int n, double dt, double stiffening) noexcept {
  for (Of& body : of_) {
    body.stride = 1;
    if (body.seconds <= 0) continue;
    body.stride = n / fewest_alike(n, dt, body.seconds / stiffening);
  }
}

int Strides::acts_for(std::size_t body, int left, double dt, bool each) noexcept {
  Of& of = of_[body];
  if (of.ahead > 0.5 * dt) {
    of.ahead -= dt;
    return 0;
  }
  const int until_next = left % of.stride == 0 ? of.stride : left % of.stride;
  const int steps = each ? 1 : until_next;
  of.ahead = (steps - 1) * dt;
  ++of.acted;
  return steps;
}

void Strides::restart() noexcept {
  for (Of& body : of_) body.ahead = 0;
}

}  // namespace palpate::physics
