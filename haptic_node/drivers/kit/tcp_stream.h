#pragma once
// A connection to a service, on this machine or the next one. One thread; not the real-time one.

#include <chrono>
#include <stdexcept>
#include <string>

namespace palpate::haptic::kit {

/// The connection has ended, or the other side does not keep to its protocol.
struct ConnectionLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class TcpStream {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// @throws ConnectionLost, with the system's words
  TcpStream(const std::string& host, const std::string& port);
  ~TcpStream();
  TcpStream(const TcpStream&) = delete;
  TcpStream& operator=(const TcpStream&) = delete;

  /// Small messages leave at once. @throws ConnectionLost
  void send_all(const std::string& bytes);

  /// From a signal handler: what fits into the socket's buffer now. @return whether that was all
  bool send_now(const std::string& bytes) const noexcept;

  /// Appends what has come to `input`; waits for something until `end`.
  /// @return false if nothing came
  /// @throws ConnectionLost
  bool read_more(std::string& input, Time end);

 private:
  int socket_ = -1;
};

}  // namespace palpate::haptic::kit
