// The kernel of tetrahedra, compiled once per instruction set: tet_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include "physics_node/step/fem/tet_kernel.h"
// after the context
#include "physics_node/step/fem/tet_corners.inl"
#include "physics_node/step/fem/tet_move.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// Copies the nodes of a block at u + beta v, and what their neighbourhood has swollen by.
template <class Real, bool nodal>
void copy_nodes(const TetContext<Real>& m, const TetBlock& block, Real* copy) {
  using Q = Quad<Real>;
  const Real beta = m.beta;
  for (std::size_t n = 0; n < block.n_parts; ++n) {
    const auto node = static_cast<std::size_t>(m.node[block.first_part + n]);
    typename Q::V x;
    Q::load(m.u + 4 * node, x);
    if (beta != 0) {
      typename Q::V v;
      Q::load(m.v + 4 * node, v);
      x += beta * v;
    }
    if constexpr (nodal) x[3] = m.mean[m.share[block.first_part + n]];
    Q::store(copy + 4 * n, x);
  }
}

template <class P, class Batch>
inline __attribute__((always_inline)) TetSlopes<typename P::V> load_slopes(const Batch& batch,
                                                                           std::size_t lane) {
  TetSlopes<typename P::V> b;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j) b[k][j] = P::load(batch.slope[k][j] + lane);
  return b;
}

/// Nodes of the lanes from `lane` on; their fourth entries are added to `fourth`.
template <class P, class Real, std::size_t n, class V = typename P::V>
inline __attribute__((always_inline)) void load_corners(const Real* copy, const TetBatch<Real, n>& batch,
                                                        std::size_t lane, std::array<Column<V>, n>& u,
                                                        V& fourth) {
  unrolled<n>([&](int a) __attribute__((always_inline)) {
    V entries[4];
    load_corner<n>(copy, batch.corner[lane] + a, entries);
    for (std::size_t i = 0; i < 3; ++i) u[static_cast<std::size_t>(a)][i] = entries[i];
    fourth += entries[3];
  });
}

/// V_t / 4 (J_t - 1) of each tetrahedron to its corners.
template <class Real>
void swell(const TetContext<Real>& m, std::size_t b) {
  using P = Pack<Real>;
  using V = typename P::V;
  const TetBlock block = m.blocks[b];
  alignas(64) Real copy[4 * most_block_nodes];
  copy_nodes<Real, false>(m, block, copy);
  Real* swelling = m.swelling + block.first_part;
  std::memset(swelling, 0, block.n_parts * sizeof(Real));
  for (std::size_t n = 0; n < block.n_batches; ++n) {
    const TetBatch<Real>& batch = m.batches[block.first_batch + n];
    alignas(64) Real share[tet_lanes];
    for (std::size_t lane = 0; lane < tet_lanes; lane += P::width) {
      std::array<Column<V>, 4> u;
      V unused{};
      load_corners<P>(copy, batch, lane, u, unused);
      const V change = tet_volume_change<P>(load_slopes<P>(batch, lane), u);
      P::store(share + lane, P::load(batch.volume + lane) * change * P::all(Real(0.25)));
    }
    unrolled<tet_lanes>([&](int lane) __attribute__((always_inline)) {
      const Real of_lane = share[lane];
      for (const std::uint16_t corner : batch.corner[lane]) number_at(swelling, corner) += of_lane;
    });
  }
}

/// Sums the parts of each share.
template <class Real>
void average(const TetContext<Real>& m, std::size_t chunk, Index end) {
  double energy = 0;
  const Index first = static_cast<Index>(chunk) * tet_chunk;
  for (auto s = static_cast<std::size_t>(first); s < static_cast<std::size_t>(end); ++s) {
    Real sum = 0;
    for (Index p = m.share_begin[s]; p < m.share_begin[s + 1]; ++p) sum += m.swelling[m.share_part[p]];
    const Real mean = sum * m.share_volume[s];
    m.mean[s] = mean;
    energy += m.share_energy[s] * static_cast<double>(mean) * static_cast<double>(mean);
  }
  m.elastic_of_shares[chunk] = energy;
}

/// Sums what it is given lane by lane, in the same order whatever the width.
template <class Real>
struct ByLane {
  alignas(64) Real sum[tet_lanes] = {};
  void add(std::size_t lane, typename Pack<Real>::V v) {
    Pack<Real>::store(sum + lane, Pack<Real>::load(sum + lane) + v);
  }
  double total() const {
    double all = 0;
    for (const Real s : sum) all += static_cast<double>(s);
    return all;
  }
};

/// Elements of first order, under the volumes of their nodes or their own.
template <class Real, bool nodal_>
struct FirstOrder {
  static constexpr std::size_t n = 4;
  static constexpr bool nodal = nodal_;
  using Forces = TetForces<Pack<Real>>;
  static const TetBatch<Real, n>* batches(const TetContext<Real>& m) { return m.batches; }
  template <bool watched, class V, class U>
  static inline __attribute__((always_inline)) void compute(const TetConstants<Real>& k,
                                                            const TetSlopes<V>& b, V volume, const U& u,
                                                            V fourth, Forces& out) {
    tet_forces<Pack<Real>, nodal, watched>(k, b, volume, u, Pack<Real>::all(Real(0.25)) * fourth, out);
  }
};
template <class Real>
struct SecondOrder {
  static constexpr std::size_t n = 10;
  static constexpr bool nodal = false;
  using Forces = Tet10Forces<Pack<Real>>;
  static const TetBatch<Real, n>* batches(const TetContext<Real>& m) { return m.batches10; }
  template <bool watched, class V, class U>
  static inline __attribute__((always_inline)) void compute(const TetConstants<Real>& k,
                                                            const TetSlopes<V>& b, V volume, const U& u, V,
                                                            Forces& out) {
    tet10_forces<Pack<Real>, watched>(k, b, volume, u, out);
  }
};

template <class Real, class Element, bool watched, bool with_forces>
void block_forces(const TetContext<Real>& m, std::size_t b) {
  using P = Pack<Real>;
  using V = typename P::V;
  using Q = Quad<Real>;
  const TetBlock block = m.blocks[b];
  const TetConstants<Real> k = m.constants[block.material];
  alignas(64) Real copy[4 * most_block_nodes];
  copy_nodes<Real, Element::nodal>(m, block, copy);
  Real* sums = m.force + 4 * block.first_part;
  if constexpr (with_forces) std::memset(sums, 0, 4 * block.n_parts * sizeof(Real));
  [[maybe_unused]] ByLane<Real> elastic;
  [[maybe_unused]] V stiffest{}, least = P::all(1);
  for (std::size_t n = 0; n < block.n_batches; ++n) {
    const auto& batch = Element::batches(m)[block.first_batch + n];
    for (std::size_t lane = 0; lane < tet_lanes; lane += P::width) {
      std::array<Column<V>, Element::n> u;
      V fourth{};
      load_corners<P>(copy, batch, lane, u, fourth);
      typename Element::Forces out;
      Element::template compute<watched>(k, load_slopes<P>(batch, lane), P::load(batch.volume + lane), u,
                                         fourth, out);
      if constexpr (watched) {
        elastic.add(lane, out.energy);
        stiffest = P::larger(stiffest, out.stiffness);
        least = out.change < least ? out.change : least;
      }
      if constexpr (with_forces) {
        alignas(64) Real forces[Element::n][4 * P::width];
        unrolled<Element::n>([&](int a) __attribute__((always_inline)) {
          const Column<V>& f = out.f[static_cast<std::size_t>(a)];
          V entries[4] = {f[0], f[1], f[2], V{}};
          store_corner<Real>(entries, forces[a]);
        });
        // Lane after lane, so that the order is that of the list.
        unrolled<P::width>([&](int l) __attribute__((always_inline)) {
          const std::uint16_t* corner = batch.corner[lane + static_cast<std::size_t>(l)];
          for (std::size_t a = 0; a < Element::n; ++a) {
            typename Q::V sum, f;
            Real* at = node_at(sums, corner[a]);
            Q::load(at, sum);
            Q::load(forces[a] + place_of<P>(l), f);
            Q::store(at, sum + f);
          }
        });
      }
    }
  }
  if constexpr (watched) {
    m.elastic[b] = elastic.total();
    m.stiffest[b] = static_cast<double>(P::largest(stiffest)) / m.stiffness_at_rest[block.material];
    m.least_J[b] = 1 - static_cast<double>(P::largest(-least));
  }
}

template <class Real, class Element>
TetKernel<Real> kernel_of_element() {
  TetKernel<Real> kernel{.forces = &block_forces<Real, Element, false, true>,
                         .watched_forces = &block_forces<Real, Element, true, true>,
                         .energies = &block_forces<Real, Element, true, false>,
                         .move = &move_nodes<Real>};
  if constexpr (Element::nodal) kernel.swell = &swell<Real>, kernel.average = &average<Real>;
  return kernel;
}

}  // namespace

template <class Real>
TetKernel<Real> tet_kernel(TetKind kind) {
  switch (kind) {
    case TetKind::plain:
      return kernel_of_element<Real, FirstOrder<Real, false>>();
    case TetKind::nodal:
      return kernel_of_element<Real, FirstOrder<Real, true>>();
    case TetKind::second_order:
      break;
  }
  return kernel_of_element<Real, SecondOrder<Real>>();
}

template TetKernel<float> tet_kernel<float>(TetKind);
template TetKernel<double> tet_kernel<double>(TetKind);

}  // namespace palpate::physics::PALPATE_KERNEL
