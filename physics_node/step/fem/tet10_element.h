#pragma once
// A tetrahedron of second order with straight edges: ten nodes, and the law at four points inside.
//
// At a point with the barycentric coordinates L the slopes of the shape functions are sums of the four of first order, so that the
// gradient is that of a linear tetrahedron whose corners have moved by
//
//   w_a = - u_a + 4 sum over c of L_c u_ac,   u_aa = u_a, u_ac of the middle of edge ac,      H = sum over a of w_a b_a^T
//
// and forces go back the same way. The points have L_g = beta and alpha else, weights V / 4: exact for polynomials of second degree.
// Nothing else is stored than of a linear one. It bends, and nearly keeps volume without locking: four volumes to 10 nodes.
// Limit: edges stay straight at rest.
// Source: Zienkiewicz & Taylor, The Finite Element Method, vol. 1, chapter 8; Hammer & Stroud 1956 for the points.

#include "physics_node/mesh/tet_mesh.h"
#include "physics_node/step/fem/tet_element.h"

namespace palpate::physics {

/// Barycentric coordinates of a point, where it is near and elsewhere: (5 + 3 sqrt(5)) / 20, (5 - sqrt(5)) / 20
inline constexpr double tet10_near = 0.58541019662496845, tet10_far = 0.13819660112501052;

/// Which node lies between two corners; of one and the same, the corner.
inline constexpr std::array<std::array<std::size_t, 4>, 4> tet10_between = {
    {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}}};

template <class P>
struct Tet10Forces {
  using T = typename P::V;
  std::array<Column<T>, 10> f;  // on each node [N]
  T change;                     // least J - 1 of the points; only where it was asked for
  T energy,
      stiffness;  // [J]; bound of the tangent of the stress at the points [Pa]; only where they were asked for
};

/// What a node gives to w of all points, and the more to that of the point whose barycentric coordinate is near it.
template <class P>
struct Tet10Shares {
  using T = typename P::V;
  using Real = typename P::Number;
  T far4 = P::all(Real(4 * tet10_far)), more4 = P::all(Real(4 * (tet10_near - tet10_far)));
  T far4_less = P::all(Real(4 * tet10_far - 1));

  /// Of w_a, the same for all points.
  inline __attribute__((always_inline)) std::array<Column<T>, 4> base(
      const std::array<Column<T>, 10>& u) const noexcept {
    std::array<Column<T>, 4> base;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t i = 0; i < 3; ++i) {
        T middles{};
        for (std::size_t c = 0; c < 4; ++c)
          if (c != a) middles = middles + u[tet10_between[a][c]][i];
        base[a][i] = P::fma(far4, middles, far4_less * u[a][i]);
      }
    return base;
  }
  /// w_a of a point.
  inline __attribute__((always_inline)) std::array<Column<T>, 4> at(const std::array<Column<T>, 4>& base,
                                                                    const std::array<Column<T>, 10>& u,
                                                                    std::size_t point) const noexcept {
    std::array<Column<T>, 4> w;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t i = 0; i < 3; ++i) w[a][i] = P::fma(more4, u[tet10_between[a][point]][i], base[a][i]);
    return w;
  }
  /// Forces on w_a of each point to the nodes.
  inline __attribute__((always_inline)) void back(const std::array<std::array<Column<T>, 4>, 4>& g,
                                                  std::array<Column<T>, 10>& f) const noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<T, 4> sum;
      for (std::size_t a = 0; a < 4; ++a) {
        sum[a] = (g[0][a][i] + g[1][a][i]) + (g[2][a][i] + g[3][a][i]);
        f[a][i] = P::fma(more4, g[a][a][i], far4_less * sum[a]);
      }
      for (std::size_t e = 0; e < 6; ++e) {
        const std::size_t a = tet_edges[e][0], c = tet_edges[e][1];
        f[4 + e][i] = P::fma(more4, g[c][a][i] + g[a][c][i], far4 * (sum[a] + sum[c]));
      }
    }
  }
};

/// The damper of all points.
template <class P, bool apart_>
struct Tet10Damping {
  using T = typename P::V;
  static constexpr bool any = true, apart = apart_;
  T beta;                              // [s]
  const std::array<Column<T>, 10>* v;  // of the nodes [m/s]
  T power{};
  Eigenvalues<T> stretch{}, stretch_of_areas{};  // see TetDamping
  std::array<Column<T>, 10> f;                   // its part alone; only apart [N]
};

/// @param damping  Undamped or Tet10Damping
template <class P, bool with_energy, class Real, class Damping, class T = typename P::V>
inline __attribute__((always_inline)) void tet10_forces(const TetConstants<Real>& k, const TetSlopes<T>& b,
                                                        T volume, const std::array<Column<T>, 10>& u,
                                                        Damping& damping, Tet10Forces<P>& out) noexcept {
  const T quarter = P::all(Real(0.25)) * volume;
  const Tet10Shares<P> shares;
  const std::array<Column<T>, 4> base = shares.base(u);
  [[maybe_unused]] std::array<Column<T>, 4> base_v;
  if constexpr (Damping::any) base_v = shares.base(*damping.v);
  std::array<std::array<Column<T>, 4>, 4> g;  // forces on the corners of the linear one, by point
  [[maybe_unused]] std::array<std::array<Column<T>, 4>, 4> g_of_rate;
  for (std::size_t p = 0; p < 4; ++p) {
    TetForces<P> at_point;
    const std::array<Column<T>, 4> w = shares.at(base, u, p);
    if constexpr (Damping::any) {
      const std::array<Column<T>, 4> rate = shares.at(base_v, *damping.v, p);
      TetDamping<P, Damping::apart> here{.beta = damping.beta, .v = &rate};
      tet_forces<P, false, with_energy>(k, b, quarter, w, T{}, here, at_point);
      damping.power = p == 0 ? here.power : damping.power + here.power;
      if constexpr (with_energy) widen(damping.stretch, here.stretch);
      if constexpr (Damping::apart) tet_spread<P>(b, quarter, here.stress, g_of_rate[p]);
    } else {
      tet_forces<P, false, with_energy>(k, b, quarter, w, T{}, damping, at_point);
    }
    g[p] = at_point.f;
    if constexpr (with_energy) {
      out.change = p == 0 ? at_point.change : at_point.change < out.change ? at_point.change : out.change;
      out.energy = p == 0 ? at_point.energy : out.energy + at_point.energy;
      out.stiffness = p == 0                               ? at_point.stiffness
                      : out.stiffness < at_point.stiffness ? at_point.stiffness
                                                           : out.stiffness;
    }
  }
  shares.back(g, out.f);
  if constexpr (Damping::apart) shares.back(g_of_rate, damping.f);
}

}  // namespace palpate::physics
