#pragma once
// What a hexahedron forgets: a Prony series of Maxwell elements beside its law, each with a share of the modulus and a time.
//
// A term remembers a strain E_v and hourglass modes t_v to which its own rest shape has crept, and pulls by what is left:
//
//   d = E - E_v,  E = (H + H^T + H^T H) / 2,     S = share (lambda tr d I + 2 mu d),      P += F S
//   s = t - t_v,                                 G += share G(s)
//   d' = - d / tau + E',                         s' = - s / tau + t'
//
// E, t, S and G do not see a rotation, so that the cell does not either. The law itself keeps 1 - sum of shares. Under a strain
// that is held the stress falls as 1 - sum share (1 - exp(-time / tau)), exactly: between two steps the strain stands still, so d
// fades by exp(-dt / tau) whatever dt is. Half of that comes before the force and half after it, which keeps the second order of the
// leapfrog; W(d), quadratic in d, falls by the square, and what falls is what was lost.
// Source: Simo & Hughes 1998, chapter 10, with St Venant-Kirchhoff's law in the terms: it must bear what a term still remembers only.

#include <span>

#include "common/scene/material_spec.h"
#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/step/fem/hex_element.h"

namespace palpate::physics {

inline constexpr std::size_t most_relaxations = most_relaxation_terms;
inline constexpr std::size_t n_remembered = 18;  // six of a strain, twelve of the hourglass modes

/// E_v as xx, yy, zz, xy, xz, yz; then t_v of xy, xz, yz, xyz, each x, y, z.
template <class T>
using Remembered = std::array<T, n_remembered>;

template <class Real>
struct RelaxationTerm {
  Real share = 0;        // of the modulus
  Real kept_before = 1;  // exp(-dt / (2 tau)) of the step that led here
  Real kept_after = 1;   // and of the one that follows
};

/// What a term does at one instant.
template <class P>
struct TermNow {
  using T = typename P::V;
  Tensor<T> second_stress;  // S [Pa]
  Hourglass<T> g;           // G(s)
  T energy, lost_before,
      lost_after;  // held at the instant of the force; lost since the last and until the next [J]
};

/// Green's strain and hourglass modes as a term compares them with what it remembers.
template <class P, class T = typename P::V>
Remembered<T> to_remember(const Tensor<T>& h, const Hourglass<T>& t) noexcept {
  const Tensor<T> e = StVenantKirchhoff<P>::green_strain(h);
  return {e[0][0], e[1][1], e[2][2], e[0][1], e[0][2], e[1][2], t.xy[0],  t.xy[1],  t.xy[2],
          t.xz[0], t.xz[1], t.xz[2], t.yz[0], t.yz[1], t.yz[2], t.xyz[0], t.xyz[1], t.xyz[2]};
}

/// @param now         as it is
/// @param remembered  of this term; moves on
template <class P, class Real, class T = typename P::V>
TermNow<P> relax(const HexConstants<Real>& k, const RelaxationTerm<Real>& term, const Remembered<T>& now,
                 Remembered<T>& remembered) noexcept {
  const T before = P::all(term.kept_before), kept = P::all(term.kept_before * term.kept_after);
  Remembered<T> d;  // as it was after the last step's half
  for (std::size_t n = 0; n < n_remembered; ++n) {
    d[n] = now[n] - remembered[n];
    remembered[n] = now[n] - kept * d[n];
  }

  TermNow<P> out;
  const T share = P::all(term.share);
  const T two_mu = P::all(2 * term.share * k.mu);
  const T pressure = P::all(term.share * k.lambda) * (d[0] + d[1] + d[2]);
  const auto on_axis = [&](std::size_t n) { return P::fma(two_mu, d[n], pressure); };
  out.second_stress = {{{on_axis(0), two_mu * d[3], two_mu * d[4]},
                        {two_mu * d[3], on_axis(1), two_mu * d[5]},
                        {two_mu * d[4], two_mu * d[5], on_axis(2)}}};
  T density = T{};  // S : d
  for (std::size_t i = 0; i < 3; ++i) density = P::fma(out.second_stress[i][i], d[i], density);
  T shear = out.second_stress[0][1] * d[3];
  shear = P::fma(out.second_stress[0][2], d[4], shear);
  shear = P::fma(out.second_stress[1][2], d[5], shear);
  density = P::fma(P::all(2), shear, density);

  const Hourglass<T> s{
      {d[6], d[7], d[8]}, {d[9], d[10], d[11]}, {d[12], d[13], d[14]}, {d[15], d[16], d[17]}};
  out.g = hourglass_forces<P>(k, s);
  T bent = T{};
  for (std::size_t j = 0; j < 3; ++j) {
    out.g.xy[j] = share * out.g.xy[j], out.g.xz[j] = share * out.g.xz[j];
    out.g.yz[j] = share * out.g.yz[j], out.g.xyz[j] = share * out.g.xyz[j];
    bent += s.xy[j] * out.g.xy[j] + s.xz[j] * out.g.xz[j] + s.yz[j] * out.g.yz[j] + s.xyz[j] * out.g.xyz[j];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out.second_stress[i][j] = before * out.second_stress[i][j];
    out.g.xy[i] = before * out.g.xy[i], out.g.xz[i] = before * out.g.xz[i];
    out.g.yz[i] = before * out.g.yz[i], out.g.xyz[i] = before * out.g.xyz[i];
  }
  const T whole = P::all(Real(0.5)) * P::fma(P::all(k.volume), density, bent);
  const Real b2 = term.kept_before * term.kept_before, a2 = term.kept_after * term.kept_after;
  out.energy = P::all(b2) * whole;
  out.lost_before = P::all(1 - b2) * whole;
  out.lost_after = P::all(b2 * (1 - a2)) * whole;
  return out;
}

/// A cell with a memory of `n_terms` terms, for hex_forces.
template <class P, class Real>
struct Relaxing {
  using T = typename P::V;
  static constexpr bool any = true, fades = true;
  std::span<const RelaxationTerm<Real>> terms;
  std::span<Remembered<T>> remembered;  // by term; moves on
  T lost_before = T{}, lost_after = T{};

  /// What the law keeps of the modulus.
  Real law_share() const noexcept {
    Real share = 1;
    for (const auto& term : terms) share -= term.share;
    return share;
  }
  /// Bound of the tangent of law and terms, from that of the law: see its stiffness() [Pa].
  T stiffness(T of_law, const HexConstants<Real>& k, const Tensor<T>& h) const noexcept {
    const Real share = law_share();
    const StVenantKirchhoff<P> of_terms{P::all(k.mu), P::all(k.lambda)};
    return P::fma(P::all(share), of_law, P::all(1 - share) * of_terms.stiffness(h));
  }
  /// Adds what the terms pull to stress and hourglass forces. @return their energy
  T add(const HexConstants<Real>& k, const Tensor<T>& h, const Tensor<T>& f, const Hourglass<T>&,
        const Hourglass<T>& t, Tensor<T>& stress, Hourglass<T>& g) noexcept {
    const Remembered<T> now = to_remember<P>(h, t);
    Tensor<T> second{};
    T energy = T{};
    for (std::size_t n = 0; n < terms.size(); ++n) {
      const TermNow<P> term = relax<P>(k, terms[n], now, remembered[n]);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) second[i][j] = second[i][j] + term.second_stress[i][j];
        g.xy[i] += term.g.xy[i], g.xz[i] += term.g.xz[i], g.yz[i] += term.g.yz[i], g.xyz[i] += term.g.xyz[i];
      }
      energy += term.energy;
      lost_before += term.lost_before;
      lost_after += term.lost_after;
    }
    const Tensor<T> more = product<P>(f, second);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) stress[i][j] = stress[i][j] + more[i][j];
    return energy;
  }
};

}  // namespace palpate::physics
