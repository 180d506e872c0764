#pragma once
// How fast what touches parts again.

#include <algorithm>

namespace palpate::physics {

/// Change of the normal velocity in an impact, or where something rests and is pressed on.
///   v_n < 0 at impact:  dv = -(1 + e) v_n
/// An impulse at the beginning of a step changes the mean v_n of the velocities before and after the elements acted. With
/// e < 1 that would leave part of what the elements add, and what rests would sink in by it in every step: dv takes back the
/// whole approach of the step, but never more than a perfectly elastic impact would.
/// @param v_n     of the approach, < 0 [m/s]
/// @param v_move  at which the step moves them [m/s]
inline double rebound(double e, double v_n, double v_move) noexcept {
  return std::min(std::max(-(1 + e) * v_n, -v_move), -2 * v_n);
}

}  // namespace palpate::physics
