// The kernel of fast_kernel.h, compiled once per instruction set: fast_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/fast_kernel.h"
#include "physics_node/step/fem/hex_damper.h"
#include "physics_node/step/lattice/pack.h"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// What the corners of a batch have, side by side.
template <class Real>
struct Gathered {
  alignas(64) Real of[3][8][fast_lanes];

  void take(const Real* from, const std::int32_t* corner) noexcept {
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t lane = 0; lane < fast_lanes; ++lane) {
        const Real* node = from + corner[fast_lanes * a + lane];
        for (std::size_t c = 0; c < 3; ++c) of[c][a][lane] = node[c];
      }
  }
  Corners<Pack<Real>> at(std::size_t lane) const noexcept {
    Corners<Pack<Real>> w;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 8; ++a) w[c][a] = Pack<Real>::load(of[c][a] + lane);
    return w;
  }
};

template <class Real, template <class> class Law, bool physical, bool watched>
void forces(const FastContext<Real>& m, std::size_t first, std::size_t last) {
  using P = Pack<Real>;
  using V = typename P::V;
  Gathered<Real> u, v;
  for (std::size_t b = first; b < last; ++b) {
    u.take(m.u, m.corner + 8 * fast_lanes * b);
    v.take(m.v, m.corner + 8 * fast_lanes * b);
    for (std::size_t part = 0; part < fast_lanes; part += P::width) {
      const std::size_t lane = fast_lanes * b + part;
      const V stiffness = P::load(m.stiffness + lane);
      const Corners<P> w = u.at(part), moves = v.at(part);
      Damping<P, Real> damping{.beta = m.beta, .v = &moves, .weight = m.damper_weight};
      HexForces<P> out;
      hex_forces<P, Law, physical, watched>(m.k, w, out, damping);
      Real* to = m.force + forces_of_a_batch * b + part;
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t c = 0; c < 3; ++c) P::store(to + fast_lanes * (3 * a + c), stiffness * out.f[c][a]);
      // dt/2 (Q + sqrt(Q_before Q)), see damper_loss(); rounding may make Q negative where nothing moves
      const V Q = P::larger(stiffness * damping.power, V{}), before = P::load(m.power + lane);
      const V loss = P::all(Real(0.5) * m.dt_before) * (Q + P::square_root(before * Q));
      P::store(m.lost + lane, P::load(m.lost + lane) + loss);
      P::store(m.power + lane, Q);
      const V tangent = stiffness > V{} ? out.stiffness : V{};
      P::store(m.stiffest + lane, P::larger(P::load(m.stiffest + lane), tangent));
      if constexpr (watched) {
        P::store(m.elastic + lane, stiffness * out.energy);
        const V change = least_corner_change<P>(m.k, w);
        P::store(m.least_change + lane, stiffness > V{} ? change : V{});
      }
    }
  }
}

/// v := v + kick + dt f / m,   u := u + dt v
template <class Real>
void move(const FastContext<Real>& m, std::size_t first, std::size_t last) {
  for (std::size_t n = first; n < last; ++n) {
    const std::int32_t* at = m.incident + 8 * n;
    Real f[3] = {};
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t c = 0; c < 3; ++c) f[c] += m.force[static_cast<std::size_t>(at[i]) + fast_lanes * c];
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 4 * n + c;
      m.v[i] += m.kick[i] + m.dt_over_mass[n] * f[c];
      m.u[i] += m.dt * m.v[i];
      m.sum_sum_v[i] += m.sum_v[i];
      m.sum_v[i] += m.v[i];
    }
  }
}

template <class Real, template <class> class Law, bool physical>
FastKernel<Real> kernel_of() {
  return {&forces<Real, Law, physical, false>, &forces<Real, Law, physical, true>, &move<Real>};
}

}  // namespace

template <class Real>
FastKernel<Real> fast_kernel(FastKind kind) {
  if (kind.law == TissueLaw::green)
    return kind.physical ? kernel_of<Real, StVenantKirchhoff, true>()
                         : kernel_of<Real, StVenantKirchhoff, false>();
  return kind.physical ? kernel_of<Real, StableNeoHookean, true>()
                       : kernel_of<Real, StableNeoHookean, false>();
}

template FastKernel<float> fast_kernel<float>(FastKind);
template FastKernel<double> fast_kernel<double>(FastKind);

}  // namespace palpate::physics::PALPATE_KERNEL
