#pragma once
// FNV-1a, 64 bit: the state hash of a summary, checksums of scenes and volumes. Not cryptographic.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace palpate {

inline constexpr std::uint64_t hash_seed = 0xcbf29ce484222325ULL;

/// Hash of bytes, continued from `seed`.
inline std::uint64_t hash_bytes(const void* data, std::size_t n, std::uint64_t seed = hash_seed) noexcept {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < n; ++i) seed = (seed ^ bytes[i]) * 0x100000001b3ULL;
  return seed;
}

inline std::uint64_t hash_text(std::string_view text, std::uint64_t seed = hash_seed) noexcept {
  return hash_bytes(text.data(), text.size(), seed);
}

/// Sixteen hexadecimal digits.
std::string hex_of(std::uint64_t hash);

}  // namespace palpate
