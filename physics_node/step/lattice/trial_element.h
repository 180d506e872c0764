#pragma once
// One element at a trial state, in double precision.

#include <algorithm>
#include <cmath>

#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

struct TrialElement {
  Vec3 n;                 // direction, toward the far end
  double l = 0;           // length [m]
  double f_s = 0, k = 0;  // static force [N] and its slope [N/m]
  double c = 0;           // [N s/m]
  double stored = 0;      // recoverable energy [J]
  double taken = 0;       // that yield and break would take if they were committed here [J]
};

/// The element of `slot` whose first end is cell i, at displacements u + D. `memory` is that of the state.
template <class Real>
TrialElement trial_element(const Body& body, const LatticeState<Real>& s, const ElementSlot<Real>& slot,
                           Index i, const Vec3& shift) {
  const auto first = static_cast<std::size_t>(i);
  const auto far = static_cast<std::size_t>(i + slot.offset);
  const auto owner = static_cast<std::size_t>(i + slot.memory);
  const auto h = static_cast<std::size_t>(slot.half);
  const bool varied = !body.law_of.empty();
  const auto pick = [&](const ByHalf<Real>& of_each, Real of_all) {
    return static_cast<double>(varied ? of_each[h][owner] : of_all);
  };
  Vec3 D, d;
  for (Eigen::Index a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    D[a] = static_cast<double>(slot.D[axis]);
    d[a] = static_cast<double>(s.u[axis][far]) - static_cast<double>(s.u[axis][first]) + shift[a];
  }
  const auto L = static_cast<double>(slot.L);
  const double q = std::max(d.dot(2 * D + d), -0.999999 * L * L);
  TrialElement e;
  e.l = std::sqrt(L * L + q);
  e.n = (D + d) / e.l;
  e.c = pick(s.varied.c, slot.c);
  e.k = pick(s.varied.k1, slot.k1);
  const double k1 = e.k;
  const double stretch = q / (e.l + L);
  const bool yields = s.l_c[h].size() > 0;
  const double l_c = yields ? static_cast<double>(s.l_c[h][owner]) : 0.0;
  e.f_s = k1 * (stretch - l_c);
  if (yields) {
    const double s_y = pick(s.varied.yield, slot.yield) + static_cast<double>(s.hardening[h][owner]);
    if (stretch > s_y) {
      e.k = pick(s.varied.k2, slot.k2);
      const double f_y = k1 * (s_y - l_c);
      e.f_s = f_y + e.k * (stretch - s_y);
      e.taken = 0.5 * (f_y + e.f_s) * (1 - e.k / k1) * (stretch - s_y);
      if (stretch > pick(s.varied.snap, slot.snap)) {  // gone when it is committed
        e.taken += e.f_s * e.f_s / (2 * k1);
        e.f_s = e.k = 0;
      }
    }
  }
  e.stored = e.f_s * e.f_s / (2 * k1);
  return e;
}

}  // namespace palpate::physics
