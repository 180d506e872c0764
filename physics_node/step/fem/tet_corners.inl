#pragma once
// Corners of tetrahedra side by side, from vectors of nodes one after the other and back; compiled once per instruction set, as
// part of a kernel that defines PALPATE_KERNEL.

#include <cstdint>
#include <cstring>
#include <utility>

#include "physics_node/step/lattice/pack.h"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// x, y, z and one more of a node.
template <class Real>
struct Quad {
  typedef Real V __attribute__((vector_size(4 * sizeof(Real))));
  static inline __attribute__((always_inline)) void load(const Real* from, V& to) {
    std::memcpy(&to, from, sizeof(V));
  }
  static inline __attribute__((always_inline)) void store(Real* to, const V& from) {
    std::memcpy(to, &from, sizeof(V));
  }
};

/// Entry n of the result is entry pick(n) of a and b one after the other.
template <class V, class Half, class Pick, int... n>
inline __attribute__((always_inline)) V chosen(const Half& a, const Half& b, Pick,
                                               std::integer_sequence<int, n...>) {
  return __builtin_shufflevector(a, b, Pick::of(n)...);
}
struct OneAfterTheOther {
  static constexpr int of(int n) { return n; }
};
/// In each block of four of two vectors of W: low or high entries in turns; or the low or high halves one after the other.
template <int W, bool high>
struct InTurns {
  static constexpr int of(int n) { return n / 4 * 4 + (high ? 2 : 0) + n % 4 / 2 + n % 2 * W; }
};
template <int W, bool high>
struct Halves {
  static constexpr int of(int n) { return n / 4 * 4 + (high ? 2 : 0) + n % 2 + n % 4 / 2 * W; }
};

/// Four by four blocks of a vector: entry i of vector j becomes entry j of vector i.
template <class P, class V = typename P::V>
inline __attribute__((always_inline)) void transpose(V (&r)[4]) {
  constexpr int W = P::width;
  constexpr auto all = std::make_integer_sequence<int, W>{};
  const V a = chosen<V>(r[0], r[1], InTurns<W, false>{}, all),
          b = chosen<V>(r[2], r[3], InTurns<W, false>{}, all);
  const V c = chosen<V>(r[0], r[1], InTurns<W, true>{}, all),
          d = chosen<V>(r[2], r[3], InTurns<W, true>{}, all);
  r[0] = chosen<V>(a, b, Halves<W, false>{}, all), r[1] = chosen<V>(a, b, Halves<W, true>{}, all);
  r[2] = chosen<V>(c, d, Halves<W, false>{}, all), r[3] = chosen<V>(c, d, Halves<W, true>{}, all);
}

/// Vectors of the nodes of every fourth lane, one after the other.
template <class Real, class P = Pack<Real>, class V = typename P::V>
inline __attribute__((always_inline)) void join(const Real* nodes, const std::uint16_t* corner, V& out) {
  using Q = typename Quad<Real>::V;
  constexpr int W = P::width;
  if constexpr (W == 4) {
    Quad<Real>::load(nodes + 4 * corner[0], out);
  } else {
    typedef Real Two __attribute__((vector_size(8 * sizeof(Real))));
    constexpr auto eight = std::make_integer_sequence<int, 8>{};
    Q a, b;
    Quad<Real>::load(nodes + 4 * corner[0], a);
    Quad<Real>::load(nodes + 4 * corner[16], b);
    if constexpr (W == 8) {
      out = chosen<V>(a, b, OneAfterTheOther{}, eight);
    } else {
      Q c, d;
      Quad<Real>::load(nodes + 4 * corner[32], c);
      Quad<Real>::load(nodes + 4 * corner[48], d);
      const Two low = chosen<Two>(a, b, OneAfterTheOther{}, eight),
                high = chosen<Two>(c, d, OneAfterTheOther{}, eight);
      out = chosen<V>(low, high, OneAfterTheOther{}, std::make_integer_sequence<int, 16>{});
    }
  }
}

/// The four entries of one corner of each lane. @param corner  of the first lane; those of the next lie four further
template <class Real, class P = Pack<Real>, class V = typename P::V>
inline __attribute__((always_inline)) void load_corner(const Real* nodes, const std::uint16_t* corner,
                                                       V (&out)[4]) {
  if constexpr (P::width >= 4) {
    for (int n = 0; n < 4; ++n) join<Real>(nodes, corner + 4 * n, out[n]);
    transpose<P>(out);
  } else {
    for (int i = 0; i < 4; ++i) {
      Real lanes[P::width];
      for (int lane = 0; lane < P::width; ++lane) lanes[lane] = nodes[4 * corner[4 * lane] + i];
      out[i] = P::load(lanes);
    }
  }
}

/// Vectors of one corner of each lane, lane after lane. @param entries  x, y, z; they are used up
template <class Real, class P = Pack<Real>, class V = typename P::V>
inline __attribute__((always_inline)) void store_corner(V (&entries)[4], Real (&out)[4 * P::width]) {
  if constexpr (P::width >= 4) {
    transpose<P>(entries);
    for (int n = 0; n < 4; ++n) P::store(out + n * P::width, entries[n]);  // of lanes n, n + 4, n + 8, ...
  } else {
    for (int i = 0; i < 4; ++i)
      for (int lane = 0; lane < P::width; ++lane) out[4 * lane + i] = entries[i][lane];
  }
}

/// Where store_corner has put the vector of a lane.
template <class P>
constexpr int place_of(int lane) {
  return P::width >= 4 ? lane % 4 * P::width + lane / 4 * 4 : 4 * lane;
}

}  // namespace
}  // namespace palpate::physics::PALPATE_KERNEL
