// The kernel of hex_flow.h, compiled once per instruction set: hex_flow_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include "physics_node/step/lattice/hex_flow.h"
#include "physics_node/step/lattice/pack.h"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// Why half: as in hex_strain.inl; what passes its limit unseen flows in the next watched step, and nothing is lost.
constexpr double near_yield_share = 0.5;

/// Cells side by side.
template <class Real>
struct FlowingCells {
  using P = Pack<Real>;
  using V = typename P::V;
  Index i;
  Index at[8];
  V stiffness;
  HexStrained<P> now;
  Plastic<V> plastic;
};

/// Corners of what is gone may be anywhere; no strain of theirs may become infinite.
template <class Real, class P = Pack<Real>>
inline __attribute__((always_inline)) Corners<P> corners_at(const FlowingCells<Real>& cells,
                                                            const Real* const of[3]) {
  Corners<P> w;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 8; ++a)
      w[c][a] = P::where(cells.stiffness > typename P::V{}, P::load(of[c] + cells.i + cells.at[a]));
  return w;
}

/// Of cells that have never yielded: S^2 is no more than this, from H and the modes as they are, |s|^2 <= |F|^2 |m|^2. A third of what S
/// itself costs, and most cells are far from yielding.
template <class Real, class P = Pack<Real>, class V = typename P::V>
inline __attribute__((always_inline)) V most_stress2(const HexFlowContext<Real>& m, const Corners<P>& w) {
  Tensor<V> h;
  V q{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Modes<V> mode = modes_of(w[i]);
    h[i] = {mode.x * P::all(m.k.per_4h[0]), mode.y * P::all(m.k.per_4h[1]), mode.z * P::all(m.k.per_4h[2])};
    q = P::fma(mode.xy, mode.xy,
               P::fma(mode.xz, mode.xz, P::fma(mode.yz, mode.yz, P::fma(mode.xyz, mode.xyz, q))));
  }
  Tensor<V> c = stretching<P>(h);
  const V size = trace(c), third = size * P::all(Real(1.0 / 3.0));
  for (std::size_t i = 0; i < 3; ++i) c[i][i] = c[i][i] - third;
  const V bent = (P::all(3) + size) * q * P::all(m.most_bent);
  return P::fma(P::all(Real(1.5)), double_dot<P>(c, c), bent);
}

/// Lets cells flow that are beyond their limit, and books it: few are, so it is a function of its own.
///
/// The trapezoid of the forces then and now (see element_step.h) takes from K + W what W loses where it stands, and half a step of
/// what the force loses times the velocity; of that the plastic part is the integral of Y + K alpha over d alpha.
template <class Real, class P = Pack<Real>, class V = typename P::V>
__attribute__((noinline)) void flow(const HexFlowContext<Real>& m, FlowingCells<Real>& cells,
                                    const HexStressed<P>& is, V stress, V limit, RunYield& of_run) {
  const V hardening = P::load(m.hardening + cells.i);
  const HexFlow<P> did = hex_flow<P>(m.k, cells.now, is, stress, limit, hardening, cells.plastic);
  const V power = hex_flow_power<P>(m.k, cells.now, is, did, corners_at(cells, m.v));
  const V mu_v = P::all(m.k.mu * m.k.volume);
  const V plastic = mu_v * did.strain * P::fma(P::all(Real(0.5)) * hardening, did.strain, limit);
  // - power: the force that is taken away pulled against the motion.
  const V lost = P::fnma(P::all(Real(0.5) * m.dt_before), power, did.lost);
  const auto flows = stress > limit;
  of_run.plastic += static_cast<double>(P::sum(P::where(flows, cells.stiffness * plastic)));
  of_run.numerical += static_cast<double>(P::sum(P::where(flows, cells.stiffness * (lost - plastic))));
  for (int lane = 0; lane < P::width; ++lane) of_run.flows += flows[lane] != 0 ? 1 : 0;
  for (std::size_t n = 0; n < n_plastic; ++n) {
    Real* at = m.memory[n] + cells.i;
    cells.plastic[n] = flows ? cells.plastic[n] : P::load(at);
    P::store(at, cells.plastic[n]);
  }
}

/// @param yielded  memory is not all zero
template <class Real, bool yielded>
void flow_run(const HexFlowContext<Real>& m, std::size_t r) {
  using P = Pack<Real>;
  using V = typename P::V;
  const HexRun run = m.runs[r];
  RunYield& of_run = m.of_run[r];
  FlowingCells<Real> cells;
  for (Index a = 0; a < 8; ++a) cells.at[a] = (a & 1) * run.right + (a >> 1 & 1) * m.up_y + (a >> 2) * m.up_z;
  V elastic{}, bound2{};
  bool near = false;
  for (Index i = run.first; i < run.first + run.count; i += P::width) {
    cells.i = i;
    cells.stiffness = P::load(m.stiffness + i);
    const Corners<P> w = corners_at(cells, m.u);
    const V first = P::load(m.limit + i);
    auto may = (first > V{}) & (cells.stiffness > V{});
    if constexpr (!yielded) {
      const V enough = P::all(Real(near_yield_share)) * first;
      if (!P::any(may & (most_stress2(m, w) > enough * enough))) continue;
    }
    cells.now = hex_strained<P>(m.k, w);
    for (std::size_t n = 0; n < n_plastic; ++n)
      if constexpr (yielded)
        cells.plastic[n] = P::load(m.memory[n] + i);
      else
        cells.plastic[n] = V{};
    const HexStressed<P> is = hex_stressed<P>(m.k, cells.now, cells.plastic);
    if (m.begun != nullptr) may &= P::load(m.begun + i) == V{};
    V limit = first;
    if constexpr (yielded) limit = P::fma(P::load(m.hardening + i), cells.plastic[n_plastic - 1], first);
    const V near_limit = P::all(Real(near_yield_share)) * limit;
    near = near || P::any(may & (is.stress2 > near_limit * near_limit));
    const auto beyond = may & (is.stress2 > limit * limit);
    if (__builtin_expect(P::any(beyond), false)) {
      const Tensor<V> F = cells.now.f;
      const V J = determinant<P>(F, cofactor<P>(F));
      const V stress = P::square_root(P::where(beyond & (J > P::all(Real(least_yielding_J))), is.stress2));
      flow<Real>(m, cells, is, stress, limit, of_run);
      of_run.found = Yielded::yielded;
    }
    const V has_yielded = P::where(cells.stiffness > V{}, cells.plastic[n_plastic - 1]);
    if (!P::any_above_zero(has_yielded)) continue;
    Corners<P> out;
    const V energy = plastic_forces<P>(m.k, cells.now, cells.plastic, out);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 8; ++a) {
        Real* f = (a < 4 ? m.f[c] : m.high[c]) + i + cells.at[a];
        P::store(f, P::fma(cells.stiffness, out[c][a], P::load(f)));
      }
    elastic = P::fma(cells.stiffness, energy, elastic);
    bound2 = P::larger(bound2, P::where(cells.stiffness > V{}, plastic_bound2<P>(cells.plastic)));
  }
  if (m.watch) of_run.elastic = static_cast<double>(P::sum(elastic));
  of_run.stiffness = static_cast<double>(m.k.mu * P::largest(P::square_root(bound2)));
  if (of_run.found != Yielded::yielded) of_run.found = near ? Yielded::near : Yielded::far;
}

template <class Real>
void flow_runs(const HexFlowContext<Real>& m, Index first_run, Index last_run) {
  for (auto r = static_cast<std::size_t>(first_run); r < static_cast<std::size_t>(last_run); ++r) {
    RunYield& of_run = m.of_run[r];
    of_run.plastic = of_run.numerical = 0;
    of_run.flows = 0;
    if (m.acts[r] == 0 || (of_run.found == Yielded::far && !m.watch)) continue;
    of_run.found == Yielded::yielded ? flow_run<Real, true>(m, r) : flow_run<Real, false>(m, r);
  }
}

}  // namespace

template <class Real>
HexFlowKernel<Real> hex_flow_kernel(HexFlowKind) {
  return &flow_runs<Real>;
}

template HexFlowKernel<float> hex_flow_kernel<float>(HexFlowKind);
template HexFlowKernel<double> hex_flow_kernel<double>(HexFlowKind);

}  // namespace palpate::physics::PALPATE_KERNEL
