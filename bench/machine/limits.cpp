#include "bench/machine/limits.h"

#include <immintrin.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

namespace palpate::bench {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr int chains = 10;  // independent sums: a latency of 4 or 5 cycles times two units
constexpr long turns = 2'000'000;

// x := x a + b, held near 1 so that nothing overflows or underflows. One function per width: the vector type needs the
// target. The empty assembler line keeps the compiler from folding the chain.
#define PALPATE_CHAINS(name, isa, vector, all, expression) \
  __attribute__((target(isa))) void name() {               \
    vector x[chains];                                      \
    const vector a = all(0.999F), b = all(0.001F);         \
    for (auto& sum : x) sum = all(1);                      \
    for (long n = 0; n < turns; ++n)                       \
      for (auto& sum : x) {                                \
        sum = expression;                                  \
        asm volatile("" : "+v"(sum));                      \
      }                                                    \
  }
PALPATE_CHAINS(fused_512s, "avx512f", __m512, _mm512_set1_ps, _mm512_fmadd_ps(sum, a, b))
PALPATE_CHAINS(fused_512d, "avx512f", __m512d, _mm512_set1_pd, _mm512_fmadd_pd(sum, a, b))
PALPATE_CHAINS(fused_256s, "avx2,fma", __m256, _mm256_set1_ps, _mm256_fmadd_ps(sum, a, b))
PALPATE_CHAINS(fused_256d, "avx2,fma", __m256d, _mm256_set1_pd, _mm256_fmadd_pd(sum, a, b))
PALPATE_CHAINS(apart_512s, "avx512f", __m512, _mm512_set1_ps, _mm512_add_ps(_mm512_mul_ps(sum, a), b))
PALPATE_CHAINS(apart_512d, "avx512f", __m512d, _mm512_set1_pd, _mm512_add_pd(_mm512_mul_pd(sum, a), b))
PALPATE_CHAINS(apart_256s, "avx2", __m256, _mm256_set1_ps, _mm256_add_ps(_mm256_mul_ps(sum, a), b))
PALPATE_CHAINS(apart_256d, "avx2", __m256d, _mm256_set1_pd, _mm256_add_pd(_mm256_mul_pd(sum, a), b))
PALPATE_CHAINS(apart_128s, "sse2", __m128, _mm_set1_ps, _mm_add_ps(_mm_mul_ps(sum, a), b))
PALPATE_CHAINS(apart_128d, "sse2", __m128d, _mm_set1_pd, _mm_add_pd(_mm_mul_pd(sum, a), b))
#undef PALPATE_CHAINS

/// @param bytes  of a vector
double flops_per_s(void (*run)(), double bytes, bool single) {
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 5; ++pass) {
    const double start = seconds_now();
    run();
    least = std::min(least, seconds_now() - start);
  }
  return 2 * bytes / (single ? 4 : 8) * chains * static_cast<double>(turns) / least;
}

}  // namespace

double triad_bytes_per_s(std::size_t bytes, int threads) {
  const auto n = std::max<std::size_t>(bytes / (3 * sizeof(float)), 64);
  std::vector<float> a(n, 0.0F), b(n, 1.0F), c(n, 2.0F);
  const double moved = 3.0 * sizeof(float) * static_cast<double>(n);
  const int repeats = static_cast<int>(std::clamp(2e7 / moved, 1.0, 1e5));
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 7; ++pass) {
    const double start = seconds_now();
    for (int repeat = 0; repeat < repeats; ++repeat) {
      float* const __restrict to = a.data();
      const float* const from = b.data();
      const float* const scaled = c.data();
#pragma omp parallel for simd num_threads(threads) schedule(static) if (threads > 1)
      for (std::size_t i = 0; i < n; ++i) to[i] = from[i] + 0.5F * scaled[i];
      asm volatile("" : : "r"(to) : "memory");
    }
    least = std::min(least, (seconds_now() - start) / repeats);
  }
  return moved / least;
}

double fma_flops_per_s(bool single) {
  if (__builtin_cpu_supports("avx512f")) return flops_per_s(single ? fused_512s : fused_512d, 64, single);
  if (__builtin_cpu_supports("fma")) return flops_per_s(single ? fused_256s : fused_256d, 32, single);
  return multiply_add_flops_per_s(single);  // this machine has none
}

double multiply_add_flops_per_s(bool single) {
  if (__builtin_cpu_supports("avx512f")) return flops_per_s(single ? apart_512s : apart_512d, 64, single);
  if (__builtin_cpu_supports("avx2")) return flops_per_s(single ? apart_256s : apart_256d, 32, single);
  return flops_per_s(single ? apart_128s : apart_128d, 16, single);
}

}  // namespace palpate::bench
