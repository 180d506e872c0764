// The kernels of a level, compiled once per instruction set: level_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include <utility>

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_damper.h"
#include "physics_node/step/fem/hex_tangent.h"
#include "physics_node/step/lattice/pack.h"
#include "physics_node/step/multigrid/level_kernel.h"
// after level_kernel.h
#include "physics_node/step/multigrid/level_nodes.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

constexpr std::size_t n_lanes = batch_size;

/// What waits for the next part of a batch, by row and number: what nodes get from their left cells. And what waits for the end of a
/// batch that is gathered, by number and corner: nodes may be corners of many of its cells, and their sums have one order.
template <class Real, std::size_t count>
struct BatchSum {
  typename Pack<Real>::V carried[4][count];
  Real waiting[count][8][n_lanes];

  void begin() {
    for (auto& row : carried)
      for (auto& one : row) one = typename Pack<Real>::V{};
  }
  /// @param low  of the corners 0 to 3; @param high  of the others
  void end(const LevelContext<Real>& m, const CellBatch& batch, Real* const* low, Real* const* high) {
    if (batch.gathered < 0) return;
    const Index* corners = m.corners + batch.gathered;
    for (std::size_t e = 0; e < count; ++e)
      for (std::size_t a = 0; a < 8; ++a) {
        Real* to = a < 4 ? low[e] : high[e];
        for (std::size_t n = 0; n < n_lanes; ++n) to[corners[n_lanes * a + n]] += waiting[e][a][n];
      }
  }
};

/// Part of a batch that fills a vector: cells [lane, lane + width).
template <class Real>
class BatchPart {
 public:
  using P = Pack<Real>;
  using V = typename P::V;

  BatchPart(const LevelContext<Real>& m, const CellBatch& batch, std::size_t lane)
      : batch_(batch), listed_(batch.gathered < 0 ? nullptr : m.corners + batch.gathered), lane_(lane) {}

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

  /// What each cell gives to the two corners of a row along x: number `e` of `count`.
  template <std::size_t count>
  void add(std::size_t row, std::size_t e, Real* to, V left, V right, BatchSum<Real, count>& sum) const {
    if (batch_.gathered >= 0) {
      P::store(sum.waiting[e][2 * row] + lane_, left);
      P::store(sum.waiting[e][2 * row + 1] + lane_, right);
      return;
    }
    Real* at = to + batch_.at[row] + lane_;
    V& carried = sum.carried[row][e];
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

/// Calls visit(part, its numbers, sum) for the parts of the batches of a layer, and adds up.
template <std::size_t count, class Real, class Visit>
void for_parts(const LevelContext<Real>& m, Index layer, Real* const* low, Real* const* high,
               const Visit& visit) {
  const CellLayer& l = m.layers[layer];
  BatchSum<Real, count> sum;
  for (Index b = l.first_batch; b < l.last_batch; ++b) {
    sum.begin();
    Real* numbers = m.tangent + static_cast<std::ptrdiff_t>(b) * tangent_numbers * batch_size;
    for (std::size_t lane = 0; lane < n_lanes; lane += static_cast<std::size_t>(Pack<Real>::width))
      visit(BatchPart<Real>(m, m.batches[b], lane), numbers + lane, sum);
    sum.end(m, m.batches[b], low, high);
  }
}

template <class Real>
HexTangent<typename Pack<Real>::V> load_tangent(const Real* numbers) {
  HexTangent<typename Pack<Real>::V> at;
  for (std::size_t n = 0; n < 9; ++n) at.f[n / 3][n % 3] = Pack<Real>::load(numbers + n * n_lanes);
  at.q = Pack<Real>::load(numbers + 9 * n_lanes);
  at.every = Pack<Real>::load(numbers + 11 * n_lanes);
  return at;
}

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
  for_parts<6>(
      m, layer, m.inverse.data(), m.block_high.data(), [&](const auto& part, Real* numbers, auto& sum) {
        const auto at = hex_tangent_at<P>(m.k, part.load(m.u));
        for (std::size_t n = 0; n < 9; ++n) P::store(numbers + n * n_lanes, at.f[n / 3][n % 3]);
        P::store(numbers + 9 * n_lanes, at.q);
        P::store(numbers + 11 * n_lanes, at.every);
        const auto blocks = hex_tangent_blocks<P, physical>(m.k, at);
        const auto stiffness = P::load(numbers + 10 * n_lanes) * P::all(m.scale);
        for (std::size_t r = 0; r < 4; ++r)
          for (std::size_t e = 0; e < 6; ++e) {
            const std::size_t left = r < 2 ? 2 * r : 7 - 2 * r, right = r < 2 ? 2 * r + 1 : 6 - 2 * r;
            part.add(r, e, (r < 2 ? m.inverse : m.block_high)[e], stiffness * blocks[left][e],
                     stiffness * blocks[right][e], sum);
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
                typename P::V scale, BatchSum<Real, 3>& sum) {
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      part.add(r, c, (r < 2 ? m.low : m.high)[c], scale * f[c][2 * r], scale * f[c][2 * r + 1], sum);
}

template <class Real, bool physical>
void product(const LevelContext<Real>& m, const NodeVector<Real>& p, Index layer) {
  using P = Pack<Real>;
  for_parts<3>(m, layer, m.low.data(), m.high.data(), [&](const auto& part, const Real* numbers, auto& sum) {
    Corners<P> f;
    hex_tangent_times<P, physical>(m.k, load_tangent(numbers), part.load(p), f);
    add_forces(m, part, f, P::load(numbers + 10 * n_lanes) * P::all(m.scale), sum);
  });
  dense_product(m, p, layer);
}

/// u + d of all corners, less that of the first: differences of neighbours lose no digits, however far a body has moved, and a step
/// is finer than what it is added to.
template <class Real, class P = Pack<Real>>
Corners<P> moved(Corners<P> u, const Corners<P>& d) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto first = u[c][0];
    for (std::size_t a = 0; a < 8; ++a) u[c][a] = (d[c][a] - d[c][0]) + (u[c][a] - first);
  }
  return u;
}

template <class Real, bool physical>
double forces(const LevelContext<Real>& m, Index layer) {
  using P = Pack<Real>;
  double energy = 0;
  for_parts<3>(m, layer, m.low.data(), m.high.data(), [&](const auto& part, const Real* numbers, auto& sum) {
    HexForces<P> out;
    const Corners<P> u = part.load(m.u), at = moved<Real>(u, part.load(m.d));
    if (m.lag > 0) {
      Lagging<P, Real> damper{m.lag, hex_remembered<P>(m.k, u)};
      hex_forces<P, StableNeoHookean, physical, true>(m.k, at, out, damper);
    } else {
      hex_forces<P, StableNeoHookean, physical, true>(m.k, at, out);
    }
    const auto stiffness = P::load(numbers + 10 * n_lanes);
    add_forces(m, part, out.f, stiffness, sum);
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
