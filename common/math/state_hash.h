#pragma once
// XXH3, 64 bit, of whole states: some GB/s, where FNV-1a takes a multiplication for each byte. Not cryptographic. The same
// number on every machine of this byte order. The one door to xxhash.

#include <cstddef>
#include <cstdint>

namespace palpate {

/// Hash of bytes, continued from `seed`.
std::uint64_t hash_state(const void* data, std::size_t n, std::uint64_t seed) noexcept;

}  // namespace palpate
