#include "haptic_node/drivers/inverse3/websocket_accept.h"

#include <bit>

namespace palpate::haptic::inverse3 {
namespace {

using Hash = std::array<std::uint32_t, 5>;

void take_block(const std::uint8_t* block, Hash& hash) {
  std::array<std::uint32_t, 80> w{};
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t j = 0; j < 4; ++j) w[i] = (w[i] << 8) | block[4 * i + j];
  for (std::size_t i = 16; i < 80; ++i) w[i] = std::rotl(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
  auto [a, b, c, d, e] = hash;
  for (std::size_t i = 0; i < 80; ++i) {
    const std::uint32_t f = i < 20   ? ((b & c) | (~b & d)) + 0x5a827999u
                            : i < 40 ? (b ^ c ^ d) + 0x6ed9eba1u
                            : i < 60 ? ((b & c) | (b & d) | (c & d)) + 0x8f1bbcdcu
                                     : (b ^ c ^ d) + 0xca62c1d6u;
    const std::uint32_t next = std::rotl(a, 5) + f + e + w[i];
    e = d;
    d = c;
    c = std::rotl(b, 30);
    b = a;
    a = next;
  }
  const Hash step{a, b, c, d, e};
  for (std::size_t i = 0; i < 5; ++i) hash[i] += step[i];
}

}  // namespace

std::array<std::uint8_t, 20> sha1(const std::string& text) {
  std::string padded = text + '\x80';
  while (padded.size() % 64 != 56) padded += '\0';
  const std::uint64_t bits = 8 * static_cast<std::uint64_t>(text.size());
  for (int shift = 56; shift >= 0; shift -= 8) padded += static_cast<char>((bits >> shift) & 0xff);
  Hash hash{0x67452301u, 0xefcdab89u, 0x98badcfeu, 0x10325476u, 0xc3d2e1f0u};
  for (std::size_t i = 0; i < padded.size(); i += 64)
    take_block(reinterpret_cast<const std::uint8_t*>(padded.data()) + i, hash);
  std::array<std::uint8_t, 20> bytes{};
  for (std::size_t i = 0; i < 20; ++i)
    bytes[i] = static_cast<std::uint8_t>((hash[i / 4] >> (24 - 8 * (i % 4))) & 0xff);
  return bytes;
}

std::string base64(const std::uint8_t* bytes, std::size_t n) {
  static const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < n; i += 3) {
    std::uint32_t three = 0;
    for (std::size_t j = 0; j < 3; ++j) three = (three << 8) | (i + j < n ? bytes[i + j] : 0u);
    for (std::size_t j = 0; j < 4; ++j) text += i + j <= n ? letters[(three >> (18 - 6 * j)) & 63] : '=';
  }
  return text;
}

std::string accept_of(const std::string& key) {
  const auto hash = sha1(key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11");
  return base64(hash.data(), hash.size());
}

}  // namespace palpate::haptic::inverse3
