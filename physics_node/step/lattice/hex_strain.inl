// The kernel of hex_strain.h, compiled once per instruction set: hex_strain_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include "physics_node/step/fem/hex_element.h"
#include "physics_node/step/fem/hex_tension.h"
#include "physics_node/step/lattice/hex_strain.h"
#include "physics_node/step/lattice/pack.h"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// Why half: a cell stretched to half of it is looked at in every step, others once a frame; to cross the rest within one frame of
/// 1 ms it must be torn at 100 a second.
constexpr double near_share = 0.5;

/// Least minors of the cells of a run, at their limit and near it; only signs matter.
template <class Real>
struct LeastMinors {
  Real beyond, near;
};

template <class Real>
LeastMinors<Real> least_minors(const HexStrain<Real>& m, const HexRun& run) {
  using P = Pack<Real>;
  using V = typename P::V;
  V beyond = P::all(1), near = P::all(1);
  for (Index i = run.first; i < run.first + run.count; i += P::width) {
    Tensor<V> h;
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<V, 8> w;
      for (Index a = 0; a < 8; ++a)
        w[static_cast<std::size_t>(a)] =
            P::load(m.u[c] + i + (a & 1) * run.right + (a >> 1 & 1) * m.up_y + (a >> 2) * m.up_z);
      const Modes<V> mode = modes_of(w);
      h[c] = {mode.x * P::all(m.per_4h[0]), mode.y * P::all(m.per_4h[1]), mode.z * P::all(m.per_4h[2])};
    }
    const TensionLimit<V> limit{P::load(m.stretch + i), P::load(m.tension + i)};
    const V B = breaking_stretch<P>(limit, P::all(m.of_volume), h);
    const Tensor<V> c = stretching<P>(h);
    const V at_limit = least_minor<P>(B, c), half_way = least_minor<P>(P::all(Real(near_share)) * B, c);
    const auto may = limit.stretch > V{};
    beyond = (at_limit < beyond) & may ? at_limit : beyond;
    near = (half_way < near) & may ? half_way : near;
  }
  return {-P::largest(-beyond), -P::largest(-near)};
}

template <class Real>
void look(const HexStrain<Real>& m, Index first_run, Index last_run) {
  for (auto r = static_cast<std::size_t>(first_run); r < static_cast<std::size_t>(last_run); ++r) {
    if (m.acts[r] == 0 || (m.only_near && m.found[r] == Strained::far)) continue;
    const LeastMinors<Real> least = least_minors(m, m.runs[r]);
    m.found[r] = least.beyond <= 0 ? Strained::beyond : least.near <= 0 ? Strained::near : Strained::far;
  }
}

}  // namespace

template <class Real>
HexStrainKernel<Real> hex_strain_kernel(HexStrainKind) {
  return &look<Real>;
}

template HexStrainKernel<float> hex_strain_kernel<float>(HexStrainKind);
template HexStrainKernel<double> hex_strain_kernel<double>(HexStrainKind);

}  // namespace palpate::physics::PALPATE_KERNEL
