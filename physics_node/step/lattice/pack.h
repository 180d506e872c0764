#pragma once
// W numbers side by side, in the widest vectors that the including file is compiled for. Only operations that IEEE 754
// rounds in one way, so that every width that can fuse a multiplication with an addition gives the same bits.

#include <immintrin.h>

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace palpate::physics {
namespace PALPATE_KERNEL {  // one copy per instruction set: see element_kernel.inl

#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int vector_bytes = 32;
#else
inline constexpr int vector_bytes = 16;
#endif
/// Of vectors for what is left of a run, where that fills no more than one of these. Why: half of a vector of 64 bytes often is
/// half of its work, half of one of 32 bytes is all of it.
inline constexpr int tail_bytes = vector_bytes == 64 ? 32 : vector_bytes;

template <class Real, int bytes = vector_bytes>
struct Pack {
  using Number = Real;
  static constexpr int width = bytes / static_cast<int>(sizeof(Real));
  using Integer = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;
  typedef Real V __attribute__((vector_size(bytes)));
  typedef Integer I __attribute__((vector_size(bytes)));
  typedef std::uint32_t M __attribute__((vector_size(width * 4)));

  // Why not memcpy: gcc 12 takes what that loads through memory of its own.
  typedef Real Anywhere __attribute__((vector_size(bytes), aligned(alignof(Real)), may_alias));

  static V load(const Real* p) { return *reinterpret_cast<const Anywhere*>(p); }
  static void store(Real* p, V v) { *reinterpret_cast<Anywhere*>(p) = v; }
  static V all(Real value) {
    return value - V{};  // a broadcast; V{} + value would be an addition, which makes 0 of -0
  }
  static V larger(V a, V b) { return a > b ? a : b; }
  static bool any(I lanes) {
    Integer bits = 0;
    for (int n = 0; n < width; ++n) bits |= lanes[n];
    return bits != 0;
  }
  static bool any_above_zero(V v) {
#if defined(__AVX512F__)
    if constexpr (bytes == 64) {
      if constexpr (sizeof(Real) == 4)
        return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(v), _mm512_setzero_ps(), _CMP_GT_OQ) != 0;
      else
        return _mm512_cmp_pd_mask(reinterpret_cast<__m512d>(v), _mm512_setzero_pd(), _CMP_GT_OQ) != 0;
    }
#endif
#if defined(__AVX2__)
    if constexpr (bytes == 32) {
      if constexpr (sizeof(Real) == 4)
        return _mm256_movemask_ps(reinterpret_cast<__m256>(v > V{})) != 0;
      else
        return _mm256_movemask_pd(reinterpret_cast<__m256d>(v > V{})) != 0;
    }
#endif
    if constexpr (bytes == 16) {
      if constexpr (sizeof(Real) == 4)
        return _mm_movemask_ps(reinterpret_cast<__m128>(v > V{})) != 0;
      else
        return _mm_movemask_pd(reinterpret_cast<__m128d>(v > V{})) != 0;
    }
  }
  static Real sum(V v) {
    Real total = 0;
    for (int n = 0; n < width; ++n) total += v[n];
    return total;
  }
  static Real largest(V v) {
    Real most = v[0];
    for (int n = 1; n < width; ++n) most = v[n] > most ? v[n] : most;
    return most;
  }

  /// a b + c, rounded once. Without the instruction: twice.
  static V fma(V a, V b, V c) {
#if defined(__AVX512F__)
    if constexpr (bytes == 64) {
      if constexpr (sizeof(Real) == 4)
        return reinterpret_cast<V>(_mm512_fmadd_ps(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b),
                                                   reinterpret_cast<__m512>(c)));
      else
        return reinterpret_cast<V>(_mm512_fmadd_pd(reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b),
                                                   reinterpret_cast<__m512d>(c)));
    }
#endif
#if defined(__FMA__)
    if constexpr (bytes == 32) {
      if constexpr (sizeof(Real) == 4)
        return reinterpret_cast<V>(_mm256_fmadd_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b),
                                                   reinterpret_cast<__m256>(c)));
      else
        return reinterpret_cast<V>(_mm256_fmadd_pd(reinterpret_cast<__m256d>(a), reinterpret_cast<__m256d>(b),
                                                   reinterpret_cast<__m256d>(c)));
    }
#endif
    if constexpr (bytes == 16) return a * b + c;
  }
  static V fma_all(V a, Real b, V c) { return fma(a, all(b), c); }
  /// c - a b, rounded once.
  static V fnma(V a, V b, V c) { return fma(-a, b, c); }

  /// The masks of `width` cells, one per lane.
  static I load_masks(const std::uint32_t* p) {
    M m;
    std::memcpy(&m, p, sizeof(m));
    return __builtin_convertvector(m, I);
  }
  /// All ones in the lanes whose mask has the bit, zero elsewhere.
  static I lanes_with(I masks, std::uint32_t bit) {
    const I wanted = I{} + static_cast<Integer>(bit);
    return (masks & wanted) == wanted;
  }
  /// v in the chosen lanes, zero elsewhere.
  static V where(I lanes, V v) { return lanes != 0 ? v : V{}; }

  static V square_root(V v) {
#if defined(__AVX512F__)
    if constexpr (bytes == 64) {
      if constexpr (sizeof(Real) == 4)
        return reinterpret_cast<V>(_mm512_sqrt_ps(reinterpret_cast<__m512>(v)));
      else
        return reinterpret_cast<V>(_mm512_sqrt_pd(reinterpret_cast<__m512d>(v)));
    }
#endif
#if defined(__AVX2__)
    if constexpr (bytes == 32) {
      if constexpr (sizeof(Real) == 4)
        return reinterpret_cast<V>(_mm256_sqrt_ps(reinterpret_cast<__m256>(v)));
      else
        return reinterpret_cast<V>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(v)));
    }
#endif
    if constexpr (bytes == 16) {
      if constexpr (sizeof(Real) == 4)
        return reinterpret_cast<V>(_mm_sqrt_ps(reinterpret_cast<__m128>(v)));
      else
        return reinterpret_cast<V>(_mm_sqrt_pd(reinterpret_cast<__m128d>(v)));
    }
  }
};

}  // namespace PALPATE_KERNEL
}  // namespace palpate::physics
