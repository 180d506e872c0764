#include "haptic_node/drivers/inverse3/websocket.h"

#include <fmt/format.h>

#include <cstdint>
#include <random>

#include "haptic_node/drivers/inverse3/websocket_accept.h"

namespace palpate::haptic::inverse3 {
namespace {

constexpr unsigned char last_of_message = 0x80, kind_mask = 0x0f;
enum Kind : unsigned char {
  continuation = 0x0,
  text_message = 0x1,
  close_frame = 0x8,
  ping = 0x9,
  pong = 0xa
};

std::string random_bytes(std::size_t n) {
  std::random_device source;
  std::string bytes(n, '\0');
  for (char& byte : bytes) byte = static_cast<char>(source() & 0xff);
  return bytes;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

WebSocket::WebSocket(const std::string& host, const std::string& port, std::chrono::milliseconds timeout)
    : stream_(host, port) {
  shake_hands(host, port, std::chrono::steady_clock::now() + timeout);
}

WebSocket::~WebSocket() {
  try {
    send_frame(close_frame, "\x03\xe8");  // 1000: done
  } catch (const ConnectionLost&) {       // it has gone first
  }
}

void WebSocket::shake_hands(const std::string& host, const std::string& port, Time end) {
  const std::string nonce = random_bytes(16);
  const std::string key = base64(reinterpret_cast<const std::uint8_t*>(nonce.data()), nonce.size());
  stream_.send_all(
      fmt::format("GET / HTTP/1.1\r\nHost: {}:{}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                  "Sec-WebSocket-Key: {}\r\nSec-WebSocket-Version: 13\r\n\r\n",
                  host, port, key));
  std::size_t head = std::string::npos;
  while ((head = input_.find("\r\n\r\n")) == std::string::npos) {
    if (!stream_.read_more(input_, end) || input_.size() > 16384)
      throw ConnectionLost("no WebSocket answers there");
  }
  const std::string answer = input_.substr(0, head + 2);
  input_.erase(0, head + 4);
  const std::string name = "\r\nsec-websocket-accept:";
  const std::size_t at = lower(answer).find(name);
  std::string accept = at == std::string::npos ? "" : answer.substr(at + name.size());
  accept = accept.substr(0, accept.find("\r\n"));
  accept.erase(0, accept.find_first_not_of(' '));
  if (!answer.starts_with("HTTP/1.1 101") || accept != accept_of(key))
    throw ConnectionLost(
        fmt::format("no WebSocket answers there, but \"{}\"", answer.substr(0, answer.find("\r\n"))));
}

/// A client masks what it sends.
std::string WebSocket::frame_of(unsigned char kind, const std::string& content) {
  std::string frame(1, static_cast<char>(last_of_message | kind));
  const auto byte = [&frame](std::uint64_t value) { frame += static_cast<char>(value & 0xff); };
  const std::uint64_t n = content.size();
  byte(0x80u | (n < 126 ? n : n < 65536 ? 126u : 127u));
  if (n >= 126)
    for (int shift = n < 65536 ? 8 : 56; shift >= 0; shift -= 8) byte(n >> shift);
  const std::string mask = random_bytes(4);
  frame += mask;
  for (std::size_t i = 0; i < content.size(); ++i) frame += static_cast<char>(content[i] ^ mask[i % 4]);
  return frame;
}

/// @return false if no whole frame comes in time
bool WebSocket::next_frame(unsigned char& head, std::string& content, Time end) {
  while (true) {
    const auto at = [this](std::size_t i) {
      return static_cast<std::uint64_t>(static_cast<unsigned char>(input_[i]));
    };
    std::size_t start = 2;
    std::uint64_t n = input_.size() < 2 ? 0 : at(1);
    if (n > 127) throw ConnectionLost("the service masks its messages, which it must not");
    const std::size_t digits = n == 126 ? 2 : n == 127 ? 8 : 0;
    start += digits;
    if (input_.size() >= start) {
      if (digits > 0) n = 0;
      for (std::size_t i = 0; i < digits; ++i) n = (n << 8) | at(2 + i);
      if (n > longest_message) throw ConnectionLost("a message of the service is too long");
      if (input_.size() >= start + n) {
        head = static_cast<unsigned char>(at(0));
        content = input_.substr(start, n);
        input_.erase(0, start + n);
        return true;
      }
    }
    if (!stream_.read_more(input_, end)) return false;
  }
}

bool WebSocket::receive_text(std::string& text, std::chrono::milliseconds timeout) {
  const Time end = std::chrono::steady_clock::now() + timeout;
  unsigned char head = 0;
  std::string content;
  while (next_frame(head, content, end)) {
    switch (head & kind_mask) {
      case continuation:
      case text_message:
        partial_ += content;
        if (partial_.size() > longest_message) throw ConnectionLost("a message of the service is too long");
        if ((head & last_of_message) == 0) break;
        text.swap(partial_);
        partial_.clear();
        return true;
      case ping:
        send_frame(pong, content);
        break;
      case pong:
        break;
      default:
        throw ConnectionLost("the service has ended the session");
    }
  }
  return false;
}

}  // namespace palpate::haptic::inverse3
