#pragma once
// How far tissue gives at once along the normal, where what presses it lies on more of it the harder it presses,
// as a ball does:
//
//   dz/dF = R / c,   c = (1 + s F)^(1/3),   z = 3/2 R F (c + 1) / (c^2 + c + 1)
//
// That of a rigid ball of radius rho on an elastic half space, on a patch that is never smaller than a_0:
//
//   dF/dz = 2 E' a,   a^2 = a_0^2 + rho z,   E' = E / (1 - nu^2)
//   =>   R = 1 / (2 E' a_0),   s = 3 rho / (4 E' a_0^3),   c^2 = 1 + 2 s z / (3 R)
//
// Hertz's for a_0 = 0; what does not grow, a flat end, has s = 0.
// Source: Hertz 1882; Johnson, Contact Mechanics, 3.4 and 4.2. The least patch is ours.

#include <cmath>

namespace palpate {

struct GrowingContact {
  double compliance = 0;  // R, of the first touch [m/N]
  double growth = 0;      // s [1/N]

  /// @param stiffness  E' [Pa]  @param patch  a_0 [m]  @param radius  rho; 0: flat [m]
  static GrowingContact of_ball(double stiffness, double patch, double radius) noexcept {
    return {1 / (2 * stiffness * patch), 3 * radius / (4 * stiffness * patch * patch * patch)};
  }
  /// z [m]. Here and below: F >= 0 [N]. No cancellation, however small s F is.
  double give(double F) const noexcept { return give(F, widening(F)); }
  /// dz/dF [m/N]
  double slope(double F) const noexcept { return compliance / widening(F); }
  /// dz/dF where it has given z [m/N]
  double slope_at(double z) const noexcept {
    return compliance / std::sqrt(1 + 2 * growth * z / (3 * compliance));
  }
  /// z about F: offset + slope F.
  struct Tangent {
    double slope, offset;
  };
  Tangent tangent(double F) const noexcept {
    const double c = widening(F), slope = compliance / c;
    return {slope, give(F, c) - slope * F};
  }
  /// The integral of F dz [J].
  double energy(double F) const noexcept {
    const double c = widening(F), x = c - 1, part = F / (c * c + c + 1);
    return 3 * compliance * part * part * (1.5 + x * (2 + x * (1 + 0.2 * x)));
  }

 private:
  double give(double F, double c) const noexcept { return 1.5 * compliance * F * (c + 1) / (c * c + c + 1); }
  double widening(double F) const noexcept { return growth > 0 ? std::cbrt(1 + growth * F) : 1.0; }
};

}  // namespace palpate
