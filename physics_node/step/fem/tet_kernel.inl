// The kernel of tetrahedra, compiled once per instruction set: tet_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include <cmath>

#include "physics_node/step/fem/tet_kernel.h"
// after the context
#include "physics_node/step/fem/tet_corners.inl"
#include "physics_node/step/fem/tet_move.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// Copies vectors of the nodes of a block, and of their shares a number each to the fourth entries.
template <class Real, bool with_fourth>
void copy_nodes(const TetContext<Real>& m, const TetBlock& block, const Real* vectors,
                [[maybe_unused]] const Real* fourth, Real* copy) {
  using Q = Quad<Real>;
  for (std::size_t n = 0; n < block.n_parts; ++n) {
    const auto node = static_cast<std::size_t>(m.node[block.first_part + n]);
    typename Q::V x;
    Q::load(vectors + 4 * node, x);
    if constexpr (with_fourth) x[3] = fourth[m.share[block.first_part + n]];
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

/// V_t / 4 (J_t - 1) of each tetrahedron to its corners; damped V_t / 4 J_t', too.
template <class Real, bool damped>
void swell(const TetContext<Real>& m, std::size_t b) {
  using P = Pack<Real>;
  using V = typename P::V;
  constexpr std::size_t n_sums = damped ? 2 : 1;
  typedef Real Sums __attribute__((vector_size(n_sums * sizeof(Real))));
  const TetBlock block = m.blocks[b];
  alignas(64) Real copy[4 * most_block_nodes];
  copy_nodes<Real, false>(m, block, m.u, nullptr, copy);
  [[maybe_unused]] alignas(64) Real copy_v[damped ? 4 * most_block_nodes : 1];
  if constexpr (damped) copy_nodes<Real, false>(m, block, m.v, nullptr, copy_v);
  Real* swelling = m.swelling + n_sums * block.first_part;
  std::memset(swelling, 0, n_sums * block.n_parts * sizeof(Real));
  for (std::size_t n = 0; n < block.n_batches; ++n) {
    const TetBatch<Real>& batch = m.batches[block.first_batch + n];
    alignas(64) Real share[n_sums][tet_lanes];
    for (std::size_t lane = 0; lane < tet_lanes; lane += P::width) {
      std::array<Column<V>, 4> u;
      V unused{};
      load_corners<P>(copy, batch, lane, u, unused);
      const V quarter = P::load(batch.volume + lane) * P::all(Real(0.25));
      if constexpr (damped) {
        std::array<Column<V>, 4> v;
        load_corners<P>(copy_v, batch, lane, v, unused);
        const TetGrowth<V> growth = tet_growth<P>(load_slopes<P>(batch, lane), u, v);
        P::store(share[0] + lane, quarter * growth.change);
        P::store(share[1] + lane, quarter * growth.rate);
      } else {
        P::store(share[0] + lane, quarter * tet_volume_change<P>(load_slopes<P>(batch, lane), u));
      }
    }
    unrolled<tet_lanes>([&](int lane) __attribute__((always_inline)) {
      Sums of_lane;
      for (std::size_t i = 0; i < n_sums; ++i) of_lane[i] = share[i][lane];
      for (const std::uint16_t corner : batch.corner[lane]) {
        Real* at = numbers_at<n_sums>(swelling, corner);
        Sums sum;
        std::memcpy(&sum, at, sizeof(Sums));
        sum += of_lane;
        std::memcpy(at, &sum, sizeof(Sums));
      }
    });
  }
}

/// Sums the parts of each share.
template <class Real, bool damped>
void average(const TetContext<Real>& m, std::size_t chunk, Index end) {
  constexpr std::size_t n_sums = damped ? 2 : 1;
  double energy = 0;
  [[maybe_unused]] double power = 0, lagging = 0;
  const Index first = static_cast<Index>(chunk) * tet_chunk;
  for (auto s = static_cast<std::size_t>(first); s < static_cast<std::size_t>(end); ++s) {
    Real sum[n_sums] = {};
    for (Index p = m.share_begin[s]; p < m.share_begin[s + 1]; ++p)
      for (std::size_t i = 0; i < n_sums; ++i)
        sum[i] += m.swelling[n_sums * static_cast<std::size_t>(m.share_part[p]) + i];
    const Real mean = sum[0] * m.share_volume[s];
    m.mean[s] = mean;
    energy += m.share_energy[s] * static_cast<double>(mean) * static_cast<double>(mean);
    if constexpr (damped) {
      const Real rate = sum[1] * m.share_volume[s];
      m.mean_rate[s] = rate;
      const auto now = static_cast<double>(rate), before = static_cast<double>(m.mean_rate_before[s]);
      power += m.share_energy[s] * now * now;
      lagging += m.share_energy[s] * std::abs(now * before);
    }
  }
  m.elastic_of_shares[chunk] = energy;
  if constexpr (damped) {
    const auto beta = static_cast<double>(m.beta);
    m.power_of_shares[chunk] = 2 * beta * power;
    m.lost_of_shares[chunk] = beta * (power + lagging);
  }
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
  using P = Pack<Real>;
  using V = typename P::V;
  using Nodes = std::array<Column<V>, n>;
  using Forces = TetForces<P>;
  static const TetBatch<Real, n>* batches(const TetContext<Real>& m) { return m.batches; }

  /// @param fourth  sum of j_n of the corners
  template <bool watched>
  static inline __attribute__((always_inline)) void compute(const TetConstants<Real>& k,
                                                            const TetSlopes<V>& b, V volume, const Nodes& u,
                                                            V fourth, Undamped& damping, Forces& out) {
    tet_forces<P, nodal, watched>(k, b, volume, u, P::all(Real(0.25)) * fourth, damping, out);
  }

  template <bool apart>
  struct Damping : TetDamping<P, apart> {
    Nodes f;  // its part alone; only apart [N]
    Damping(V time, const Nodes* moves, V sum)
        : TetDamping<P, apart>{.beta = time, .v = moves, .mean = P::all(Real(0.25)) * sum} {}
  };
  template <bool watched, bool apart>
  static inline __attribute__((always_inline)) void compute(const TetConstants<Real>& k,
                                                            const TetSlopes<V>& b, V volume, const Nodes& u,
                                                            V fourth, Damping<apart>& damping, Forces& out) {
    tet_forces<P, nodal, watched>(k, b, volume, u, P::all(Real(0.25)) * fourth, damping, out);
    if constexpr (apart) tet_spread<P>(b, volume, damping.stress, damping.f);
  }
};
template <class Real>
struct SecondOrder {
  static constexpr std::size_t n = 10;
  static constexpr bool nodal = false;
  using P = Pack<Real>;
  using V = typename P::V;
  using Nodes = std::array<Column<V>, n>;
  using Forces = Tet10Forces<P>;
  static const TetBatch<Real, n>* batches(const TetContext<Real>& m) { return m.batches10; }

  template <bool apart>
  struct Damping : Tet10Damping<P, apart> {
    Damping(V time, const Nodes* moves, V) : Tet10Damping<P, apart>{.beta = time, .v = moves, .f = {}} {}
  };
  template <bool watched, class AnyDamping>
  static inline __attribute__((always_inline)) void compute(const TetConstants<Real>& k,
                                                            const TetSlopes<V>& b, V volume, const Nodes& u,
                                                            V, AnyDamping& damping, Forces& out) {
    tet10_forces<P, watched>(k, b, volume, u, damping, out);
  }
};

/// Adds forces on the nodes of a pack of tetrahedra to the sums of the block, lane after lane, so that the order is that of the list.
template <class Real, std::size_t n, class V = typename Pack<Real>::V>
inline __attribute__((always_inline)) void add_forces(const std::array<Column<V>, n>& f,
                                                      const TetBatch<Real, n>& batch, std::size_t lane,
                                                      Real* sums) {
  using P = Pack<Real>;
  using Q = Quad<Real>;
  alignas(64) Real forces[n][4 * P::width];
  unrolled<n>([&](int a) __attribute__((always_inline)) {
    const Column<V>& of_node = f[static_cast<std::size_t>(a)];
    V entries[4] = {of_node[0], of_node[1], of_node[2], V{}};
    store_corner<Real>(entries, forces[a]);
  });
  unrolled<P::width>([&](int l) __attribute__((always_inline)) {
    const std::uint16_t* corner = batch.corner[lane + static_cast<std::size_t>(l)];
    for (std::size_t a = 0; a < n; ++a) {
      typename Q::V sum, one;
      Real* at = node_at(sums, corner[a]);
      Q::load(at, sum);
      Q::load(forces[a] + place_of<P>(l), one);
      Q::store(at, sum + one);
    }
  });
}

/// What a sweep over the elements computes.
struct Sweep {
  bool damped = false, watched = false, with_forces = true, apart = false;
};

template <class Real, class Element, Sweep sweep>
void block_forces(const TetContext<Real>& m, std::size_t b) {
  using P = Pack<Real>;
  using V = typename P::V;
  const TetBlock block = m.blocks[b];
  const TetConstants<Real> k = m.constants[block.material];
  alignas(64) Real copy[4 * most_block_nodes];
  copy_nodes<Real, Element::nodal>(m, block, m.u, m.mean, copy);
  [[maybe_unused]] alignas(64) Real copy_v[sweep.damped ? 4 * most_block_nodes : 1];
  if constexpr (sweep.damped) copy_nodes<Real, Element::nodal>(m, block, m.v, m.mean_rate, copy_v);
  [[maybe_unused]] Real* sums = m.force + 4 * block.first_part;
  [[maybe_unused]] Real* rate_sums = nullptr;
  if constexpr (sweep.with_forces) std::memset(sums, 0, 4 * block.n_parts * sizeof(Real));
  if constexpr (sweep.apart) {
    rate_sums = m.rate_force + 4 * block.first_part;
    std::memset(rate_sums, 0, 4 * block.n_parts * sizeof(Real));
  }
  [[maybe_unused]] ByLane<Real> elastic;
  [[maybe_unused]] V stiffest{}, least = P::all(1);
  [[maybe_unused]] Eigenvalues<V> stretch, stretch_of_areas;
  [[maybe_unused]] double lost = 0;
  for (std::size_t n = 0; n < block.n_batches; ++n) {
    const auto& batch = Element::batches(m)[block.first_batch + n];
    [[maybe_unused]] ByLane<Real> power;
    for (std::size_t lane = 0; lane < tet_lanes; lane += P::width) {
      typename Element::Nodes u;
      V fourth{};
      load_corners<P>(copy, batch, lane, u, fourth);
      const TetSlopes<V> slopes = load_slopes<P>(batch, lane);
      const V volume = P::load(batch.volume + lane);
      typename Element::Forces out;
      if constexpr (sweep.damped) {
        typename Element::Nodes v;
        V fourth_of_rate{};
        load_corners<P>(copy_v, batch, lane, v, fourth_of_rate);
        typename Element::template Damping<sweep.apart> damping(P::all(m.beta), &v, fourth_of_rate);
        Element::template compute<sweep.watched>(k, slopes, volume, u, fourth, damping, out);
        power.add(lane, damping.power);
        if constexpr (sweep.watched) {
          widen(stretch, damping.stretch);
          if constexpr (Element::nodal) widen(stretch_of_areas, damping.stretch_of_areas);
        }
        if constexpr (sweep.apart) add_forces<Real>(damping.f, batch, lane, rate_sums);
      } else {
        Undamped none;
        Element::template compute<sweep.watched>(k, slopes, volume, u, fourth, none, out);
      }
      if constexpr (sweep.watched) {
        elastic.add(lane, out.energy);
        stiffest = P::larger(stiffest, out.stiffness);
        least = out.change < least ? out.change : least;
      }
      if constexpr (sweep.with_forces) add_forces<Real>(out.f, batch, lane, sums);
    }
    if constexpr (sweep.damped) {
      const double now = power.total(), squared = now * m.power_before[block.first_batch + n];
      m.power[block.first_batch + n] = now;
      lost +=
          now + (squared > 0 ? std::sqrt(squared) : 0);  // rounding may make it negative where nothing moves
    }
  }
  if constexpr (sweep.damped) m.lost[b] = 0.5 * lost;
  if constexpr (sweep.watched) {
    m.elastic[b] = elastic.total();
    const double of_law = static_cast<double>(P::largest(stiffest)) / m.stiffness_at_rest[block.material];
    m.stiffest[b] = of_law;
    if constexpr (sweep.damped) {
      const auto most = [](const Eigenvalues<V>& all) {
        const auto mean = static_cast<double>(P::largest(all.mean));
        return 1 + mean + std::sqrt(2 * static_cast<double>(P::largest(all.spread)));
      };
      const double of_stretch = most(stretch), of_areas = most(stretch_of_areas);
      m.stiffest[b] = damped_stiffening(of_law, of_stretch < of_areas ? of_areas : of_stretch, m.z);
    }
    m.least_J[b] = 1 - static_cast<double>(P::largest(-least));
  }
}

template <class Real, class Element, bool damped>
TetSweep<Real> sweep_of_element() {
  TetSweep<Real> sweep{
      .forces = &block_forces<Real, Element, Sweep{.damped = damped}>,
      .watched_forces = &block_forces<Real, Element, Sweep{.damped = damped, .watched = true}>,
      .energies =
          &block_forces<Real, Element, Sweep{.damped = damped, .watched = true, .with_forces = false}>};
  if constexpr (damped)
    sweep.apart = &block_forces<Real, Element, Sweep{.damped = true, .watched = true, .apart = true}>;
  if constexpr (Element::nodal) sweep.swell = &swell<Real, damped>, sweep.average = &average<Real, damped>;
  return sweep;
}

template <class Real, class Element>
TetKernel<Real> kernel_of_element() {
  return {.elastic = sweep_of_element<Real, Element, false>(),
          .damped = sweep_of_element<Real, Element, true>(),
          .move = &move_nodes<Real, false>,
          .move_apart = &move_nodes<Real, true>};
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
