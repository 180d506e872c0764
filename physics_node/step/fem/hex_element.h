#pragma once
// A hexahedron of one point: the law at its centre, and a stiffness of its own for what a centre cannot see.
//
// Eight corners move in one way as a whole, three ways of straining (per component, the gradient) and four that leave the
// centre unstrained, the hourglass modes. On a cube these eight are the Walsh-Hadamard vectors, so that a butterfly of sums and
// differences gives them all, and the same butterfly spreads forces. With corner signs s_x, s_y, s_z = -1 or 1:
//
//   m_S(i) = sum over corners a of s_S(a) u_i(a),     S = x, y, z, xy, xz, yz, xyz,   s_xy = s_x s_y and so on
//   H_ij   = m_j(i) / (4 h_j),   F = I + H,   t_M = F^T m_M of the four hourglass modes M
//   W      = V psi(F) + 1/2 sum t_M . G_M + k_i/2 sum |m_M|^2
//   f_i(a) = - sum_j s_j(a) [V P_ij + sum_M m_M(i) G_M,j] / (4 h_j) - sum_M s_M(a) [sum_j F_ij G_M,j + k_i m_M(i)]
//
// G is linear in t, by the energy that such a bending or twisting mode has in a plane state of stress (E' = E / (1 - nu^2)):
// a cell alone then bends as a beam does. It vanishes where the displacement is linear, and turns with the cell.
// With `physical` off only k_i is left, which is a fit. Corners that are about to fold are held besides: see hex_corners.h.
// Source: Flanagan & Belytschko 1981 for the modes; Wilson's incompatible modes for the bending energy.

#include "physics_node/step/fem/hex_corners.h"

namespace palpate::physics {

/// What a cell does to its corners, and what energy it holds.
template <class P>
struct HexForces {
  Corners<P> f;             // on each corner [N]
  typename P::V energy;     // [J]; only where it was asked for
  typename P::V stiffness;  // bound of the law's tangent at the centre [Pa]
  typename P::V fold;       // above zero: corner_forces() has something to add
};

/// A cell that nothing but its strain acts on; hex_relaxation.h and hex_damper.h have others.
struct Lasting {
  static constexpr bool any = false, fades = false;
};

/// All but what corners do that are about to fold.
/// @param w  displacements of the corners, as Corners<P> or what gives one component after the other as these do [m]
/// @param Law  of the material/ folder, with P
/// @param memory  what else pulls; where it fades, of physical cells only
template <class P, template <class> class Law, bool physical, bool with_energy, class Real, class Moved,
          class Memory, class T = typename P::V>
inline __attribute__((always_inline)) void hex_centre_forces(const HexConstants<Real>& k, const Moved& w,
                                                             HexForces<P>& out, Memory& memory) noexcept {
  static_assert(physical || !Memory::fades);
  constexpr bool bends = physical || Memory::any;
  const Law<P> law{P::all(k.mu), P::all(k.lambda)};
  const T every = P::all(k.every);
  std::array<Modes<T>, 3> m;
  Tensor<T> h;
  for (std::size_t i = 0; i < 3; ++i) {
    m[i] = modes_of(w[i]);
    h[i] = {m[i].x * P::all(k.per_4h[0]), m[i].y * P::all(k.per_4h[1]), m[i].z * P::all(k.per_4h[2])};
  }
  const Hourglass<T> mode{{m[0].xy, m[1].xy, m[2].xy},
                          {m[0].xz, m[1].xz, m[2].xz},
                          {m[0].yz, m[1].yz, m[2].yz},
                          {m[0].xyz, m[1].xyz, m[2].xyz}};
  Tensor<T> stress = law.stress(h);
  out.stiffness = law.stiffness(h);
  if constexpr (Memory::any) out.stiffness = memory.stiffness(out.stiffness, k, h);
  const Tensor<T> f = plus_identity<P>(h);
  T q = P::all(0);
  for (std::size_t i = 0; i < 3; ++i)
    q = P::fma(
        mode.xy[i], mode.xy[i],
        P::fma(mode.xz[i], mode.xz[i], P::fma(mode.yz[i], mode.yz[i], P::fma(mode.xyz[i], mode.xyz[i], q))));
  out.fold = may_fold_at<P>(k, q, h);
  Hourglass<T> g;
  [[maybe_unused]] T remembered;
  if constexpr (with_energy) out.energy = P::all(0);
  if constexpr (bends) {
    const Hourglass<T> t{transposed_times<P>(f, mode.xy), transposed_times<P>(f, mode.xz),
                         transposed_times<P>(f, mode.yz), transposed_times<P>(f, mode.xyz)};
    if constexpr (physical) {
      g = hourglass_forces<P>(k, t);
      if constexpr (with_energy)
        for (std::size_t j = 0; j < 3; ++j)
          out.energy += t.xy[j] * g.xy[j] + t.xz[j] * g.xz[j] + t.yz[j] * g.yz[j] + t.xyz[j] * g.xyz[j];
    } else {
      for (std::size_t j = 0; j < 3; ++j) g.xy[j] = g.xz[j] = g.yz[j] = g.xyz[j] = P::all(0);
    }
    if constexpr (Memory::fades) {
      const T share = P::all(memory.law_share());
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) stress[i][j] = share * stress[i][j];
        g.xy[i] = share * g.xy[i], g.xz[i] = share * g.xz[i], g.yz[i] = share * g.yz[i],
        g.xyz[i] = share * g.xyz[i];
      }
    }
    if constexpr (Memory::any) remembered = memory.add(k, h, f, mode, t, stress, g);
  }
  if constexpr (with_energy) {
    const T lasting = P::all(Real(0.5)) * every * q;
    out.energy = P::fma(P::all(k.volume), law.psi(h), P::fma(P::all(Real(0.5)), out.energy, lasting));
    // The stiffness of all modes alike does not fade.
    if constexpr (Memory::fades)
      out.energy = P::fma(P::all(memory.law_share()), out.energy - lasting, lasting + remembered);
    else if constexpr (Memory::any)
      out.energy = out.energy + remembered;
  }
  spread<P, bends>(k, every, f, mode, stress, g, out.f);
}

template <class P, template <class> class Law, bool physical, bool with_energy, class Real, class Memory,
          class T = typename P::V>
inline __attribute__((always_inline)) void hex_forces(const HexConstants<Real>& k, const Corners<P>& w,
                                                      HexForces<P>& out, Memory& memory) noexcept {
  hex_centre_forces<P, Law, physical, with_energy>(k, w, out, memory);
  if (!P::any_above_zero(out.fold)) return;
  CornerForces<P> corner;
  corner_forces<P>(k, w, corner);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < 8; ++a) out.f[i][a] = out.f[i][a] + corner.f[i][a];
  out.stiffness = out.stiffness + corner.stiffness;
  if constexpr (with_energy) out.energy = out.energy + corner.energy;
}

template <class P, template <class> class Law, bool physical, bool with_energy, class Real,
          class T = typename P::V>
inline __attribute__((always_inline)) void hex_forces(const HexConstants<Real>& k, const Corners<P>& w,
                                                      HexForces<P>& out) noexcept {
  Lasting lasting;
  hex_forces<P, Law, physical, with_energy>(k, w, out, lasting);
}

}  // namespace palpate::physics
