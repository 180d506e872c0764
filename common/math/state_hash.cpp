#include "common/math/state_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace palpate {

std::uint64_t hash_state(const void* data, std::size_t n, std::uint64_t seed) noexcept {
  return XXH3_64bits_withSeed(data, n, seed);
}

}  // namespace palpate
