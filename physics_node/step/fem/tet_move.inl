#pragma once
// How nodes of tetrahedra move; compiled once per instruction set, as part of a kernel that defines PALPATE_KERNEL.

#include "physics_node/step/fem/tet_kernel.h"
// after the context
#include "physics_node/step/fem/tet_corners.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// a . b of the first three entries.
template <class Real>
inline __attribute__((always_inline)) double dot3(const typename Quad<Real>::V& a,
                                                  const typename Quad<Real>::V& b) {
  return static_cast<double>(a[0]) * static_cast<double>(b[0]) +
         static_cast<double>(a[1]) * static_cast<double>(b[1]) +
         static_cast<double>(a[2]) * static_cast<double>(b[2]);
}

/// A node before and after its step.
template <class Real>
struct MovedNode {
  typename Quad<Real>::V u, v, u_after, v_after, acceleration;
  double mass;
};

template <class Real>
__attribute__((noinline)) void watch_node(const TetContext<Real>& m, const MovedNode<Real>& p,
                                          TetNodeLedger& ledger) {
  const typename Quad<Real>::V g = {m.g[0], m.g[1], m.g[2], 0};
  // See watch_begin in lattice/move_masses.inl: K = m v(-) . v(+) / 2, and v(+) becomes another.
  if (m.begins)
    ledger.numerical += 0.5 * p.mass * dot3<Real>(p.v, p.acceleration) *
                        (static_cast<double>(m.dt_before) - static_cast<double>(m.kick));
  if (!m.watch) return;
  const double v2 = dot3<Real>(p.v_after, p.v_after);
  ledger.speed2 = v2 > ledger.speed2 ? v2 : ledger.speed2;
  ledger.kinetic += 0.5 * p.mass * v2;
  ledger.between += 0.5 * p.mass * dot3<Real>(p.v, p.v_after);
  ledger.fallen += p.mass * dot3<Real>(p.u_after, g);
  ledger.fallen_before += p.mass * dot3<Real>(p.u, g);
}

/// Sums the parts of each node and moves it: v := v + kick (f / m + g), u := u + dt v. A held one stays.
/// @tparam apart  the damper's forces are known by themselves; see damper_loss()
template <class Real, bool apart>
void move_nodes(const TetContext<Real>& m, std::size_t chunk, Index end) {
  using Q = Quad<Real>;
  using V = typename Q::V;
  const auto first = chunk * static_cast<std::size_t>(tet_chunk);
  TetNodeLedger& ledger = m.ledger[chunk];
  ledger = {};
  const V g = {m.g[0], m.g[1], m.g[2], 0};
  const Real dt = m.dt, kick = m.kick;
  for (std::size_t n = first; n < static_cast<std::size_t>(end); ++n) {
    const Real w = m.inverse_mass[n];
    MovedNode<Real> p;
    Q::load(m.u + 4 * n, p.u);
    Q::load(m.v + 4 * n, p.v);
    V force{};
    for (Index e = m.node_begin[n]; e < m.node_begin[n + 1]; ++e) {
      V part;
      Q::load(m.force + 4 * static_cast<std::size_t>(m.node_part[e]), part);
      force += part;
    }
    if constexpr (apart) {
      V rate{}, seen;
      for (Index e = m.node_begin[n]; e < m.node_begin[n + 1]; ++e) {
        V part;
        Q::load(m.rate_force + 4 * static_cast<std::size_t>(m.node_part[e]), part);
        rate += part;
      }
      Q::load(m.seen_rate + 4 * n, seen);
      Q::store(m.seen_rate + 4 * n, rate);
      ledger.of_damper -= dot3<Real>(rate + seen, p.v);
    }
    if (w == 0) continue;
    p.acceleration = force * w + g;
    p.v_after = p.v + kick * p.acceleration;
    p.u_after = p.u + dt * p.v_after;
    Q::store(m.v + 4 * n, p.v_after);
    Q::store(m.u + 4 * n, p.u_after);
    if (m.watch || m.begins) {
      p.mass = 1 / static_cast<double>(w);
      watch_node(m, p, ledger);
    }
  }
}

}  // namespace
}  // namespace palpate::physics::PALPATE_KERNEL
