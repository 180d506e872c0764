// The kernels of a level, compiled once per instruction set: level_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include <utility>

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_tangent.h"
#include "physics_node/step/lattice/pack.h"
#include "physics_node/step/multigrid/level_kernel.h"
// after level_kernel.h
#include "physics_node/step/multigrid/level_nodes.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

constexpr std::size_t n_lanes = batch_size;

/// Part of a batch that fills a vector: cells [lane, lane + width).
template <class Real>
class BatchPart {
 public:
  using P = Pack<Real>;
  using V = typename P::V;

  BatchPart(const LevelContext<Real>& m, const CellBatch& batch, std::size_t lane)
      : batch_(batch), listed_(m.corners + batch.gathered), lane_(lane) {}

  Corners<P> load(const NodeVector<Real>& p) const {
    Corners<P> w;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 8; ++a) {
        if (batch_.gathered < 0)
          w[c][a] = P::load(p[c] + batch_.at[a / 2] + lane_ + (a & 1));
        else
          for (std::size_t n = 0; n < width; ++n) w[c][a][n] = p[c][corner(a, n)];
      }
    return w;
  }

  /// Adds what each cell gives to its corners; what a node gets from its left cell waits in `carried` for its right one.
  void add(std::size_t row, Real* to, V left, V right, V& carried) const {
    if (batch_.gathered >= 0) {
      for (std::size_t n = 0; n < width; ++n) {
        to[corner(2 * row, n)] += left[n];
        to[corner(2 * row + 1, n)] += right[n];
      }
      return;
    }
    Real* at = to + batch_.at[row] + lane_;
    P::store(at, P::load(at) + (left + shifted(carried, right, std::make_index_sequence<width>())));
    carried = right;
    if (lane_ + width == n_lanes) at[width] += right[width - 1];
  }

 private:
  static constexpr std::size_t width = P::width;

  std::size_t corner(std::size_t a, std::size_t n) const {
    return static_cast<std::size_t>(listed_[n_lanes * a + lane_ + n]);
  }
  /// The last lane of `before`, then all but the last of `now`.
  template <std::size_t... n>
  static V shifted(V before, V now, std::index_sequence<n...>) {
    return __builtin_shufflevector(before, now, (n == 0 ? width - 1 : width + n - 1)...);
  }

  const CellBatch& batch_;
  const Index* listed_;
  std::size_t lane_;
};

/// Calls begin() for each batch of a layer, then visit(part, its numbers) for the parts of it.
template <class Real, class Visit, class Begin>
void for_parts(const LevelContext<Real>& m, Index layer, const Begin& begin, const Visit& visit) {
  const CellLayer& l = m.layers[layer];
  for (Index b = l.first_batch; b < l.last_batch; ++b) {
    begin();
    Real* numbers = m.tangent + static_cast<std::ptrdiff_t>(b) * tangent_numbers * batch_size;
    for (std::size_t lane = 0; lane < n_lanes; lane += static_cast<std::size_t>(Pack<Real>::width))
      visit(BatchPart<Real>(m, m.batches[b], lane), numbers + lane);
  }
}

template <class Real>
HexTangent<typename Pack<Real>::V> load_tangent(const Real* numbers) {
  HexTangent<typename Pack<Real>::V> at;
  for (std::size_t n = 0; n < 9; ++n) at.f[n / 3][n % 3] = Pack<Real>::load(numbers + n * n_lanes);
  at.q = Pack<Real>::load(numbers + 9 * n_lanes);
  return at;
}

/// What waits for the next part of a batch: by row and number.
template <class Real, std::size_t count>
using Carried = std::array<std::array<typename Pack<Real>::V, count>, 4>;

template <class Real>
void dense_blocks(const LevelContext<Real>& m, Index layer) {
  constexpr std::size_t row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (Index n = m.layers[layer].first_dense; n < m.layers[layer].last_dense; ++n) {
    const Real* k = m.dense + static_cast<std::ptrdiff_t>(n) * 576;
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t e = 0; e < 6; ++e)
        (a < 4 ? m.inverse : m.block_high)[e][m.dense_corners[8 * n + static_cast<Index>(a)]] +=
            m.scale * k[24 * (3 * a + column[e]) + 3 * a + row[e]];
  }
}

template <class Real, bool physical>
void linearise(const LevelContext<Real>& m, Index layer) {
  using P = Pack<Real>;
  Carried<Real, 6> carried;
  const auto begin = [&] { carried = {}; };
  for_parts(m, layer, begin, [&](const BatchPart<Real>& part, Real* numbers) {
    const auto at = hex_tangent_at<P>(m.k, part.load(m.u));
    for (std::size_t n = 0; n < 9; ++n) P::store(numbers + n * n_lanes, at.f[n / 3][n % 3]);
    P::store(numbers + 9 * n_lanes, at.q);
    const auto blocks = hex_tangent_blocks<P, physical>(m.k, at);
    const auto stiffness = P::load(numbers + 10 * n_lanes) * P::all(m.scale);
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t e = 0; e < 6; ++e) {
        const std::size_t left = r < 2 ? 2 * r : 7 - 2 * r, right = r < 2 ? 2 * r + 1 : 6 - 2 * r;
        part.add(r, (r < 2 ? m.inverse : m.block_high)[e], stiffness * blocks[left][e],
                 stiffness * blocks[right][e], carried[r][e]);
      }
  });
  dense_blocks(m, layer);
}

template <class Real>
void dense_product(const LevelContext<Real>& m, const NodeVector<Real>& p, Index layer) {
  for (Index n = m.layers[layer].first_dense; n < m.layers[layer].last_dense; ++n) {
    const Real* k = m.dense + static_cast<std::ptrdiff_t>(n) * 576;
    const Index* corner = m.dense_corners + 8 * static_cast<std::ptrdiff_t>(n);
    Real f[24] = {};
    for (std::size_t e = 0; e < 24; ++e) {
      const Real move = m.scale * p[e % 3][corner[e / 3]];
      for (std::size_t o = 0; o < 24; ++o) f[o] += k[24 * e + o] * move;
    }
    for (std::size_t e = 0; e < 24; ++e) (e < 12 ? m.low : m.high)[e % 3][corner[e / 3]] += f[e];
  }
}

/// Adds the forces of the cells of a part, by component and corner.
template <class Real, class P = Pack<Real>>
void add_forces(const LevelContext<Real>& m, const BatchPart<Real>& part, const Corners<P>& f,
                typename P::V scale, Carried<Real, 3>& carried) {
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      part.add(r, (r < 2 ? m.low : m.high)[c], scale * f[c][2 * r], scale * f[c][2 * r + 1], carried[r][c]);
}

template <class Real, bool physical>
void product(const LevelContext<Real>& m, const NodeVector<Real>& p, Index layer) {
  using P = Pack<Real>;
  Carried<Real, 3> carried;
  const auto begin = [&] { carried = {}; };
  for_parts(m, layer, begin, [&](const BatchPart<Real>& part, const Real* numbers) {
    Corners<P> f;
    hex_tangent_times<P, physical>(m.k, load_tangent(numbers), part.load(p), f);
    add_forces(m, part, f, P::load(numbers + 10 * n_lanes) * P::all(m.scale), carried);
  });
  dense_product(m, p, layer);
}

template <class Real, bool physical>
double forces(const LevelContext<Real>& m, Index layer) {
  using P = Pack<Real>;
  Carried<Real, 3> carried;
  double energy = 0;
  const auto begin = [&] { carried = {}; };
  for_parts(m, layer, begin, [&](const BatchPart<Real>& part, const Real* numbers) {
    HexForces<P> out;
    hex_forces<P, StableNeoHookean, physical, true>(m.k, part.load(m.u), out);
    const auto stiffness = P::load(numbers + 10 * n_lanes);
    add_forces(m, part, out.f, stiffness, carried);
    const auto held = stiffness * out.energy;
    for (int n = 0; n < P::width; ++n) energy += static_cast<double>(held[n]);
  });
  return energy;
}

template <class Real, bool physical>
LevelKernel<Real> kernel_of() {
  return {&linearise<Real, physical>,
          &invert_blocks<Real>,
          &product<Real, physical>,
          &begin<Real>,
          &smooth<Real>,
          &residual<Real>,
          &keep<Real>,
          &forces<Real, physical>,
          &gather<Real>};
}

}  // namespace

template <class Real>
LevelKernel<Real> level_kernel(bool physical) {
  return physical ? kernel_of<Real, true>() : kernel_of<Real, false>();
}

template LevelKernel<float> level_kernel<float>(bool);
template LevelKernel<double> level_kernel<double>(bool);

}  // namespace palpate::physics::PALPATE_KERNEL
