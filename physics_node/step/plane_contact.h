#pragma once
// One mass and the planes that it may not pass, in a step that is solved as a whole: backward_euler, and balances.

#include <algorithm>
#include <array>
#include <span>

#include "physics_node/step/plane.h"

namespace palpate::physics {

/// How far a mass that begins a step at x and moves by D is from a plane then; behind it from the start: from where it began. [m]
inline double room_left(const Plane& plane, const Vec3& x, const Vec3& D) noexcept {
  return std::max(0.0, plane.n.dot(x) - plane.height) + plane.n.dot(D);
}

/// What a mass that begins a step at x may move by: n . D >= - gap, gap = n . x - height; and where it is behind the plane from the
/// start, no deeper: n . D >= 0.
struct KeptOut {
  Vec3 D =
      Vec3::Zero();   // nearest to the one asked for, where planes meet at no sharper angle than a right one
  PlaneSet at = 0;    // planes on which it then lies
  double pushed = 0;  // how far it had to be moved [m]
};
/// @param near  nearer to a plane than this it lies on it [m]
KeptOut keep_out(const Vec3& x, const Vec3& D, std::span<const Plane> planes, double near) noexcept;

/// Those of the planes `at` that push back at a mass which `force` drives into them; the others let it go.
///   R = sum of l_k n_k,  l_k >= 0,  n_k . (force + R) >= 0,  l_k = 0 where that is more
PlaneSet planes_that_push(PlaneSet at, const Vec3& force, std::span<const Plane> planes) noexcept;

/// Directions that planes take from a mass: of length 1, at right angles.
struct HeldDirections {
  std::array<Vec3, 3> n;
  int count = 0;
  /// The part of v along them.
  Vec3 part_of(const Vec3& v) const noexcept;
};
HeldDirections directions_of(PlaneSet set, std::span<const Plane> planes) noexcept;

/// S = A^-1 of a mass's 3 x 3 block A (xx yy zz yz xz xy) becomes the inverse of A in the directions that are left, and 0 in the
/// others: S - S n n^T S / (n^T S n), one direction after the other.
template <class Real>
void hold_block(const HeldDirections& held, std::array<Real*, 6> S, std::size_t i) noexcept {
  constexpr int entry[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int k = 0; k < held.count; ++k) {
    const Vec3& n = held.n[static_cast<std::size_t>(k)];
    Vec3 along = Vec3::Zero();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        along[r] += static_cast<double>(S[static_cast<std::size_t>(entry[r][c])][i]) * n[c];
    const double over = n.dot(along);
    if (!(over > 0)) continue;
    for (std::size_t e = 0; e < 6; ++e)
      S[e][i] = static_cast<Real>(static_cast<double>(S[e][i]) - along[row[e]] * along[column[e]] / over);
  }
}

/// What planes do to a mass besides holding it, at the end of a step of dt that moved it by D against their force R.
struct PlaneImpact {
  Vec3 dv = Vec3::Zero();  // of its velocity, which is D / dt [m/s]
  double contact = 0;      // energy that restitution takes [J]
  double numerical = 0;    // energy that the step takes [J]
};
/// With V = - n . v of the approach and q = m V^2 / 2 + F_n D_n, F = m (D / dt - v) / dt - R, the energy with which it arrives:
///   V > 0:   n . v' = e sqrt(2 q / m), no faster than `fastest`;  contact takes (1 - e^2) q
///   V <= 0:  n . v' stays
/// and the step what is missing then. Source: Moreau 1988 (Newton's law of impact at the end of a step).
PlaneImpact impact_of(double mass, const Vec3& v, const Vec3& D, const Vec3& R, const HeldDirections& held,
                      double dt, double e, double fastest) noexcept;

}  // namespace palpate::physics
