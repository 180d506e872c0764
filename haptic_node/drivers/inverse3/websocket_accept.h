#pragma once
// The two encodings of the opening handshake of a WebSocket. Source: RFC 6455 section 4.2.2; RFC 3174; RFC 4648.

#include <array>
#include <cstdint>
#include <string>

namespace palpate::haptic::inverse3 {

std::array<std::uint8_t, 20> sha1(const std::string& text);
std::string base64(const std::uint8_t* bytes, std::size_t n);

/// What a server must answer to `key` in the header Sec-WebSocket-Accept.
std::string accept_of(const std::string& key);

}  // namespace palpate::haptic::inverse3
