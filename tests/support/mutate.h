#pragma once
// Damaged copies of a file, the same ones for the same seed.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

namespace palpate::test {

/// One to three places of `bytes` among the first `reach` are another: a bit, a byte, or four bytes of an
/// extreme number.
inline std::string mutant(std::string bytes, std::uint64_t seed, std::size_t reach = SIZE_MAX) {
  std::mt19937_64 dice(seed);
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(dice() % n); };
  const std::size_t n = std::min(reach, bytes.size());
  for (std::size_t times = 1 + pick(3); times > 0; --times) {
    const std::size_t at = pick(n);
    switch (pick(4)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << pick(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(pick(256));
        break;
      case 2:
        for (std::size_t i = at; i < std::min(n, at + 4); ++i)
          bytes[i] = static_cast<char>(pick(2) == 0 ? 0xff : 0x7f);
        break;
      default:
        for (std::size_t i = at; i < std::min(n, at + 4); ++i) bytes[i] = '\0';
    }
  }
  return bytes;
}

}  // namespace palpate::test
