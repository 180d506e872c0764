#pragma once
// The client's side of a WebSocket (RFC 6455), as much as a service on this machine or the next one needs: text messages,
// no TLS, no extensions. One thread. Why: an event loop is no help where one message is answered by one message.

#include <chrono>
#include <string>

#include "haptic_node/drivers/kit/tcp_stream.h"

namespace palpate::haptic::inverse3 {

using kit::ConnectionLost;

class WebSocket {
 public:
  static constexpr std::size_t longest_message = 1u << 20;  // a longer one ends the connection [bytes]

  /// @throws ConnectionLost, with the system's words
  WebSocket(const std::string& host, const std::string& port, std::chrono::milliseconds timeout);
  ~WebSocket();
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;

  /// @throws ConnectionLost
  void send_text(const std::string& text) { send_frame(0x1, text); }

  /// A text message made ready for send_now().
  static std::string frame_of(const std::string& text) { return frame_of(0x1, text); }
  /// From a signal handler: a message made ready before, without waiting. @return whether all of it has left
  bool send_now(const std::string& frame) const noexcept { return stream_.send_now(frame); }

  /// The next text message. Answers pings.
  /// @return false if none is complete within the time; what has come of it is kept
  /// @throws ConnectionLost
  bool receive_text(std::string& text, std::chrono::milliseconds timeout);

 private:
  using Time = kit::TcpStream::Time;
  void shake_hands(const std::string& host, const std::string& port, Time end);
  static std::string frame_of(unsigned char kind, const std::string& content);
  void send_frame(unsigned char kind, const std::string& content) {
    stream_.send_all(frame_of(kind, content));
  }
  bool next_frame(unsigned char& head, std::string& content, Time end);

  kit::TcpStream stream_;
  std::string input_;    // received, not yet taken
  std::string partial_;  // message of several frames
};

}  // namespace palpate::haptic::inverse3
