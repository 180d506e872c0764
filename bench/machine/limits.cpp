#include "bench/machine/limits.h"

#include <immintrin.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "physics_node/step/team.h"

namespace palpate::bench {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr int chains = 12;  // independent of each other: a latency of 4 cycles times two units, and some
constexpr long turns = 2'000'000;

// x := x a + b, fused; or a product in every second chain and a sum in the others. The values stay at 1 and 0. One function
// per width: the vector type needs the target. The empty assembler line keeps the compiler from folding a chain.
#define PALPATE_CHAINS(name, isa, vector, all, even, odd) \
  __attribute__((target(isa))) void name() {              \
    vector x[chains];                                     \
    const vector a = all(1), b = all(0);                  \
    for (auto& value : x) value = all(1);                 \
    for (long n = 0; n < turns; ++n)                      \
      for (int c = 0; c < chains; c += 2) {               \
        vector& p = x[c];                                 \
        vector& q = x[c + 1];                             \
        p = even;                                         \
        q = odd;                                          \
        asm volatile("" : "+v"(p), "+v"(q));              \
      }                                                   \
    (void)b;                                              \
  }
#define PALPATE_FUSED(name, isa, vector, all, op) \
  PALPATE_CHAINS(name, isa, vector, all, op(p, a, b), op(q, a, b))
#define PALPATE_APART(name, isa, vector, all, times, plus) \
  PALPATE_CHAINS(name, isa, vector, all, times(p, a), plus(q, b))
PALPATE_FUSED(fused_512s, "avx512f", __m512, _mm512_set1_ps, _mm512_fmadd_ps)
PALPATE_FUSED(fused_512d, "avx512f", __m512d, _mm512_set1_pd, _mm512_fmadd_pd)
PALPATE_FUSED(fused_256s, "avx2,fma", __m256, _mm256_set1_ps, _mm256_fmadd_ps)
PALPATE_FUSED(fused_256d, "avx2,fma", __m256d, _mm256_set1_pd, _mm256_fmadd_pd)
PALPATE_APART(apart_512s, "avx512f", __m512, _mm512_set1_ps, _mm512_mul_ps, _mm512_add_ps)
PALPATE_APART(apart_512d, "avx512f", __m512d, _mm512_set1_pd, _mm512_mul_pd, _mm512_add_pd)
PALPATE_APART(apart_256s, "avx2", __m256, _mm256_set1_ps, _mm256_mul_ps, _mm256_add_ps)
PALPATE_APART(apart_256d, "avx2", __m256d, _mm256_set1_pd, _mm256_mul_pd, _mm256_add_pd)
PALPATE_APART(apart_128s, "sse2", __m128, _mm_set1_ps, _mm_mul_ps, _mm_add_ps)
PALPATE_APART(apart_128d, "sse2", __m128d, _mm_set1_pd, _mm_mul_pd, _mm_add_pd)
#undef PALPATE_APART
#undef PALPATE_FUSED
#undef PALPATE_CHAINS

/// @param bytes  of a vector
/// @param each   operations of one instruction on one number: 2 fused, 1 apart
double flops_per_s(void (*run)(), double bytes, int each, bool single) {
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 5; ++pass) {
    const double start = seconds_now();
    run();
    least = std::min(least, seconds_now() - start);
  }
  return each * bytes / (single ? 4 : 8) * chains * static_cast<double>(turns) / least;
}

}  // namespace

double triad_bytes_per_s(std::size_t bytes, int threads) {
  const auto n = std::max<std::size_t>(bytes / (3 * sizeof(float)), 64);
  std::vector<float> a(n, 0.0F), b(n, 1.0F), c(n, 2.0F);
  const double moved = 3.0 * sizeof(float) * static_cast<double>(n);
  const int repeats = static_cast<int>(std::clamp(2e7 / moved, 1.0, 1e5));
  physics::Team team(threads);
  const auto pieces = static_cast<std::size_t>(threads);
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 7; ++pass) {
    const double start = seconds_now();
    for (int repeat = 0; repeat < repeats; ++repeat) {
      float* const __restrict to = a.data();
      const float* const from = b.data();
      const float* const scaled = c.data();
      team.each(pieces, threads, [=](std::size_t p) {
        for (std::size_t i = p * n / pieces; i < (p + 1) * n / pieces; ++i)
          to[i] = from[i] + 0.5F * scaled[i];
      });
      asm volatile("" : : "r"(to) : "memory");
    }
    least = std::min(least, (seconds_now() - start) / repeats);
  }
  return moved / least;
}

double fma_flops_per_s(bool single) {
  if (__builtin_cpu_supports("avx512f")) return flops_per_s(single ? fused_512s : fused_512d, 64, 2, single);
  if (__builtin_cpu_supports("fma")) return flops_per_s(single ? fused_256s : fused_256d, 32, 2, single);
  return multiply_add_flops_per_s(single);  // this machine has none
}

double multiply_add_flops_per_s(bool single) {
  if (__builtin_cpu_supports("avx512f")) return flops_per_s(single ? apart_512s : apart_512d, 64, 1, single);
  if (__builtin_cpu_supports("avx2")) return flops_per_s(single ? apart_256s : apart_256d, 32, 1, single);
  return flops_per_s(single ? apart_128s : apart_128d, 16, 1, single);
}

}  // namespace palpate::bench
