#pragma once
// What resists the rate of strain of a hexahedron: Kelvin-Voigt, beta behind the strain.
//
//   S_v = beta (lambda tr E' I + 2 mu E'),   E' = (F^T F' + F'^T F) / 2,    P += F S_v
//   G_v = beta G(t'),                        t' = F^T m' + F'^T m,          G += G_v
//
// Neither E' nor t' sees a turning body, and S_v is symmetric: both momenta stay. What it takes,
//   Q = V S_v : E' + t' . G_v,   never is negative.
// Near rest it is stress from the strain that there would be beta later, so that everything lags by beta = viscosity / modulus; only
// k_i and what corners do, which are no part of the tissue, are not damped.
//
// Over an implicit step E' and t' are differences, and the damper has an energy of its own: see Lagging.

#include <cmath>

#include "physics_node/step/fem/hex_relaxation.h"

namespace palpate::physics {

/// The damper of a cell whose corners move, for hex_centre_forces.
/// @tparam Moves  Corners<P>, or what gives one component of them after the other as these do
template <class P, class Real, class Moves = Corners<P>>
struct Damping {
  using T = typename P::V;
  static constexpr bool any = true, fades = false;
  Real beta = 0;     // [s]
  const Moves* v{};  // of the corners [m/s]
  /// Of the bound of the tangent, for each |F|^2 above that at rest, see hex_damper_weight() [Pa].
  Real weight = 0;
  T power{};  // Q [W]
  // Its part of it all.
  Tensor<T> f{}, stress_of_rate{};
  Hourglass<T> mode_now{}, g_of_rate{};

  /// On the corners [N].
  inline __attribute__((always_inline)) void forces(const HexConstants<Real>& k,
                                                    Corners<P>& out) const noexcept {
    spread<P, true>(k, P::all(0), f, mode_now, stress_of_rate, g_of_rate, out);
  }

  T stiffness(T of_law, const HexConstants<Real>&, const Tensor<T>& h) const noexcept {
    const T more = P::fma(P::all(2), trace(h), double_dot<P>(h, h));  // |F|^2 - 3
    return P::fma(P::all(weight), more > P::all(0) ? more : P::all(0), of_law);
  }

  inline __attribute__((always_inline)) T add(const HexConstants<Real>& k, const Tensor<T>&,
                                              const Tensor<T>& deformed, const Hourglass<T>& mode,
                                              const Hourglass<T>&, Tensor<T>& stress,
                                              Hourglass<T>& g) noexcept {
    f = deformed, mode_now = mode;
    const std::array<Modes<T>, 3> m{modes_of((*v)[0]), modes_of((*v)[1]), modes_of((*v)[2])};
    Tensor<T> rate;  // F'
    for (std::size_t i = 0; i < 3; ++i)
      rate[i] = {m[i].x * P::all(k.per_4h[0]), m[i].y * P::all(k.per_4h[1]), m[i].z * P::all(k.per_4h[2])};
    T e[3][3];  // 2 E'; of the diagonal E'
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) {
        e[i][j] = P::fma(f[2][i], rate[2][j], P::fma(f[1][i], rate[1][j], f[0][i] * rate[0][j]));
        if (i == j) continue;
        e[i][j] =
            P::fma(rate[2][i], f[2][j], P::fma(rate[1][i], f[1][j], P::fma(rate[0][i], f[0][j], e[i][j])));
      }
    const T eta = P::all(beta * k.mu), two_eta = P::all(2 * beta * k.mu);
    const T pressure = P::all(beta * k.lambda) * (e[0][0] + e[1][1] + e[2][2]);
    Tensor<T> s;
    for (std::size_t i = 0; i < 3; ++i) {
      s[i][i] = P::fma(two_eta, e[i][i], pressure);
      for (std::size_t j = i + 1; j < 3; ++j) s[i][j] = s[j][i] = eta * e[i][j];
    }
    const T volume_power = P::fma(
        s[0][1], e[0][1],
        P::fma(
            s[0][2], e[0][2],
            P::fma(s[1][2], e[1][2], P::fma(s[0][0], e[0][0], P::fma(s[1][1], e[1][1], s[2][2] * e[2][2])))));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        stress_of_rate[i][j] = P::fma(f[i][0], s[0][j], P::fma(f[i][1], s[1][j], f[i][2] * s[2][j]));
        stress[i][j] =
            P::fma(f[i][0], s[0][j], P::fma(f[i][1], s[1][j], P::fma(f[i][2], s[2][j], stress[i][j])));
      }

    const auto rate_of = [&](const std::array<T, 3>& moves, const std::array<T, 3>& is) {
      std::array<T, 3> t = transposed_times<P>(f, moves);
      for (std::size_t j = 0; j < 3; ++j)
        t[j] = P::fma(rate[2][j], is[2], P::fma(rate[1][j], is[1], P::fma(rate[0][j], is[0], t[j])));
      return t;
    };
    const Hourglass<T> t{
        rate_of({m[0].xy, m[1].xy, m[2].xy}, mode.xy), rate_of({m[0].xz, m[1].xz, m[2].xz}, mode.xz),
        rate_of({m[0].yz, m[1].yz, m[2].yz}, mode.yz), rate_of({m[0].xyz, m[1].xyz, m[2].xyz}, mode.xyz)};
    const Hourglass<T> back = hourglass_forces<P>(k, t);
    const T b = P::all(beta);
    T bent = P::all(0);
    for (std::size_t j = 0; j < 3; ++j) {
      bent = P::fma(t.xy[j], back.xy[j], P::fma(t.xz[j], back.xz[j], bent));
      bent = P::fma(t.yz[j], back.yz[j], P::fma(t.xyz[j], back.xyz[j], bent));
      g.xy[j] = P::fma(b, back.xy[j], g.xy[j]), g.xz[j] = P::fma(b, back.xz[j], g.xz[j]);
      g.yz[j] = P::fma(b, back.yz[j], g.yz[j]), g.xyz[j] = P::fma(b, back.xyz[j], g.xyz[j]);
      g_of_rate.xy[j] = b * back.xy[j], g_of_rate.xz[j] = b * back.xz[j];
      g_of_rate.yz[j] = b * back.yz[j], g_of_rate.xyz[j] = b * back.xyz[j];
    }
    power = P::fma(P::all(k.volume), volume_power, b * bent);
    return P::all(0);
  }
};

/// How much a damper tightens the bound of the step, for Damping::weight: it grows as |F|^2 where the step is its, which shortens as
///   omega (sqrt(1 + z^2) + z),   z = beta omega / 2.
/// @param at_rest  bound of the tangent there [Pa]; @param omega  the fastest vibration [1/s]
inline double hex_damper_weight(double at_rest, double beta, double omega) {
  const double z = 0.5 * beta * omega;
  return at_rest * 2 * z / (z + std::sqrt(1 + z * z));
}

/// A cell with a memory and a damper.
template <class P, class Real, class Moves = Corners<P>>
struct RelaxingAndDamped {
  using T = typename P::V;
  static constexpr bool any = true, fades = true;
  Relaxing<P, Real> relaxing;
  Damping<P, Real, Moves> damping;

  Real law_share() const noexcept { return relaxing.law_share(); }
  T stiffness(T of_law, const HexConstants<Real>& k, const Tensor<T>& h) const noexcept {
    return damping.stiffness(relaxing.stiffness(of_law, k, h), k, h);
  }
  T add(const HexConstants<Real>& k, const Tensor<T>& h, const Tensor<T>& f, const Hourglass<T>& mode,
        const Hourglass<T>& t, Tensor<T>& stress, Hourglass<T>& g) noexcept {
    const T energy = relaxing.add(k, h, f, mode, t, stress, g);
    damping.add(k, h, f, mode, t, stress, g);
    return energy;
  }
};

/// The damper over a step of dt that is solved for: E' = (E - E_before) / dt and so on, which is a spring of the share beta / dt from
/// where the step began. Its energy is half of what it takes.
template <class P, class Real>
struct Lagging {
  using T = typename P::V;
  static constexpr bool any = true, fades = false;
  Real share = 0;  // beta / dt
  Remembered<T> before;

  T stiffness(T of_law, const HexConstants<Real>&, const Tensor<T>&) const noexcept { return of_law; }
  T add(const HexConstants<Real>& k, const Tensor<T>& h, const Tensor<T>& f, const Hourglass<T>&,
        const Hourglass<T>& t, Tensor<T>& stress, Hourglass<T>& g) noexcept {
    const RelaxationTerm<Real> spring{.share = share};
    Remembered<T> stays = before;
    const TermNow<P> pull = relax<P>(k, spring, to_remember<P>(h, t), stays);
    const Tensor<T> more = product<P>(f, pull.second_stress);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) stress[i][j] = stress[i][j] + more[i][j];
      g.xy[i] += pull.g.xy[i], g.xz[i] += pull.g.xz[i];
      g.yz[i] += pull.g.yz[i], g.xyz[i] += pull.g.xyz[i];
    }
    return pull.energy;
  }
};

/// What Lagging remembers of a cell. @param u  displacements of its corners [m]
template <class P, class Real, class T = typename P::V>
Remembered<T> hex_remembered(const HexConstants<Real>& k, const Corners<P>& u) noexcept {
  const std::array<Modes<T>, 3> m{modes_of(u[0]), modes_of(u[1]), modes_of(u[2])};
  Tensor<T> h;
  for (std::size_t i = 0; i < 3; ++i)
    h[i] = {m[i].x * P::all(k.per_4h[0]), m[i].y * P::all(k.per_4h[1]), m[i].z * P::all(k.per_4h[2])};
  const Tensor<T> f = plus_identity<P>(h);
  return to_remember<P>(h, Hourglass<T>{transposed_times<P>(f, {m[0].xy, m[1].xy, m[2].xy}),
                                        transposed_times<P>(f, {m[0].xz, m[1].xz, m[2].xz}),
                                        transposed_times<P>(f, {m[0].yz, m[1].yz, m[2].yz}),
                                        transposed_times<P>(f, {m[0].xyz, m[1].xyz, m[2].xyz})});
}

}  // namespace palpate::physics
