#include "deploy/import/phantom_noise.h"

#include <cstdint>
#include <initializer_list>
#include <numbers>

namespace palpate {
namespace {

constexpr std::uint64_t seed = 0x5eed5eed;

}  // namespace

double noise_at(int i, int j, int k) {
  std::uint64_t x = seed;
  for (const int n : {i, j, k}) {  // splitmix64
    x += 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(static_cast<std::int64_t>(n));
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    x ^= x >> 31;
  }
  double sum = 0;
  for (int n = 0; n < 4; ++n) sum += static_cast<double>(x >> (16 * n) & 0xffffU) / 65536.0 - 0.5;
  return sum * std::numbers::sqrt3;
}

}  // namespace palpate
