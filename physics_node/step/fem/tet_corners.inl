#pragma once
// Corners of tetrahedra side by side, from vectors of nodes one after the other and back; compiled once per instruction set, as
// part of a kernel that defines PALPATE_KERNEL.

#include <cstdint>
#include <cstring>
#include <type_traits>
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

/// Calls work(0), work(1), ... one after the other, without a loop.
template <int n, class Work>
inline __attribute__((always_inline)) void unrolled(const Work& work) {
  [&]<int... i>(std::integer_sequence<int, i...>) __attribute__((always_inline)) { (work(i), ...); }
  (std::make_integer_sequence<int, n>{});
}

/// Where the vector of a corner is: see TetBatch::corner.
template <class Real>
inline __attribute__((always_inline)) Real* node_at(Real* nodes, std::uint16_t corner) {
  using Byte = std::conditional_t<std::is_const_v<Real>, const char, char>;
  return reinterpret_cast<Real*>(reinterpret_cast<Byte*>(nodes) + 8 * static_cast<std::size_t>(corner));
}
/// The same of n numbers for each node.
template <std::size_t n, class Real>
inline __attribute__((always_inline)) Real* numbers_at(Real* numbers, std::uint16_t corner) {
  return reinterpret_cast<Real*>(reinterpret_cast<char*>(numbers) + 2 * n * static_cast<std::size_t>(corner));
}

/// Vectors of the nodes of every fourth lane, one after the other.
/// @tparam stride  from the corner of a lane to the same of the next
template <int stride, class Real, class P = Pack<Real>, class V = typename P::V>
inline __attribute__((always_inline)) void join(const Real* nodes, const std::uint16_t* corner, V& out) {
  const auto at = [&](int n) __attribute__((always_inline)) {
    return node_at(nodes, corner[4 * stride * n]);
  };
  if constexpr (P::width == 4) std::memcpy(&out, at(0), sizeof(V));
#if defined(__AVX2__)
  const auto pair = [&](auto n) __attribute__((always_inline)) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at(n))), _mm_loadu_ps(at(n + 1)), 1);
  };
  if constexpr (P::width == 8 && sizeof(Real) == 4) out = reinterpret_cast<V>(pair(0));
#endif
#if defined(__AVX512F__)
  if constexpr (P::width == 16)
    out = reinterpret_cast<V>(
        _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(pair(0))), _mm256_castps_pd(pair(2)), 1));
  if constexpr (P::width == 8 && sizeof(Real) == 8)
    out = reinterpret_cast<V>(
        _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(at(0))), _mm256_loadu_pd(at(1)), 1));
#endif
}

/// The four entries of one corner of each lane. @param corner  of the first lane
template <int stride, class Real, class P = Pack<Real>, class V = typename P::V>
inline __attribute__((always_inline)) void load_corner(const Real* nodes, const std::uint16_t* corner,
                                                       V (&out)[4]) {
  if constexpr (P::width >= 4) {
    unrolled<4>([&](int n)
                    __attribute__((always_inline)) { join<stride>(nodes, corner + stride * n, out[n]); });
    transpose<P>(out);
  } else {
    for (int i = 0; i < 4; ++i) {
      Real lanes[P::width];
      for (int lane = 0; lane < P::width; ++lane) lanes[lane] = node_at(nodes, corner[stride * lane])[i];
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
