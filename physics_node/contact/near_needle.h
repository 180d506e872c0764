#pragma once
// How tissue gives way between a needle and the ball in whose mean the elements feel it (pierced_tissue.h): what the
// elements are too coarse to know, so that what the hand feels does not depend on them.
//
//   tip, before it enters:  D(F) - F / (1.15 E* r),   F = E (0.22 D^2 + 1.3 a D)
//   shaft, by its length:   along ln(0.51 r / a) / (2 pi G),   across (3 - 4 nu) ln(0.51 r / a) / (8 pi G (1 - nu))
//
// a is the needle's radius, r that of the ball, E* = E / (1 - nu^2). As a spring the tip's is the secant at the force
// that enters.
// Source: F = beta E D^2 deep in, whatever the tip: Fakhouri, Hutchens & Crosby 2015, Shojaeifard & Bacca 2025. Its
// numbers, 0.22 and 1.3, are those of our own elements under a ball (E 10 kPa, nu 0.45, radius 2 mm, cells of 1.25 mm, to
// 1.9 radii). 1.15: what elements give way by under such a ball at a surface, within 10 % (r of 1.5 to 4 cells). Along and
// across: lines in an infinite body (Kelvin); 0.51 r: the distance whose logarithm is the mean over two places of a ball.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::physics {

struct NearNeedle {
  double modulus = 0, poisson_ratio = 0;  // [Pa]
  double radius = 0, reach = 0;           // a, r [m]

  /// D: how deep a tip dents thick tissue with a force [m].
  double dent(double force) const noexcept {
    constexpr double beta = 0.22, shallow = 1.3;
    const double s = shallow * radius;
    return (std::sqrt(s * s + 4 * beta * force / modulus) - s) / (2 * beta);
  }
  /// What of it the elements do not know [m].
  double tip(double force) const noexcept {
    constexpr double at_a_surface = 1.15;
    const double plane = modulus / (1 - poisson_ratio * poisson_ratio);
    return std::max(0.0, dent(force) - force / (at_a_surface * plane * reach));
  }
  /// By length of shaft and force [m^2/N].
  double along() const noexcept { return logarithm() / (2 * std::numbers::pi * shear()); }
  double across() const noexcept {
    const double nu = poisson_ratio;
    return (3 - 4 * nu) * logarithm() / (8 * std::numbers::pi * shear() * (1 - nu));
  }

 private:
  double shear() const noexcept { return modulus / (2 * (1 + poisson_ratio)); }
  double logarithm() const noexcept {
    constexpr double of_reach = 0.51;
    return std::log(std::max(1.0, of_reach * reach / radius));
  }
};

}  // namespace palpate::physics
