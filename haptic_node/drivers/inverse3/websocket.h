#pragma once
// The client's side of a WebSocket (RFC 6455), as much as a service on this machine or the next one needs: text messages,
// no TLS, no extensions. One thread. Why: an event loop is no help where one message is answered by one message.

#include <chrono>
#include <stdexcept>
#include <string>

namespace palpate::haptic::inverse3 {

/// The connection has ended, or the other side does not keep to the protocol.
struct ConnectionLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

  /// The next text message. Answers pings.
  /// @return false if none is complete within the time; what has come of it is kept
  /// @throws ConnectionLost
  bool receive_text(std::string& text, std::chrono::milliseconds timeout);

 private:
  using Time = std::chrono::steady_clock::time_point;
  void connect_to(const std::string& host, const std::string& port);
  void shake_hands(const std::string& host, const std::string& port, Time end);
  void send_all(const std::string& bytes);
  void send_frame(unsigned char kind, const std::string& content);
  bool read_more(Time end);
  bool next_frame(unsigned char& head, std::string& content, Time end);

  int socket_ = -1;
  std::string input_;    // received, not yet taken
  std::string partial_;  // message of several frames
};

}  // namespace palpate::haptic::inverse3
