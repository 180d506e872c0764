#include "haptic_node/drivers/kit/tcp_stream.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

namespace palpate::haptic::kit {

TcpStream::TcpStream(const std::string& host, const std::string& port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int failed = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found); failed != 0)
    throw ConnectionLost(gai_strerror(failed));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, freeaddrinfo);
  int error = 0;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    socket_ = socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol);
    if (socket_ >= 0 && connect(socket_, one->ai_addr, one->ai_addrlen) == 0) {
      const int on = 1;
      setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      return;
    }
    error = errno;
    if (socket_ >= 0) close(socket_);
  }
  throw ConnectionLost(std::strerror(error));
}

TcpStream::~TcpStream() { close(socket_); }

void TcpStream::send_all(const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t n = send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw ConnectionLost(std::strerror(errno));
    sent += static_cast<std::size_t>(n);
  }
}

bool TcpStream::send_now(const std::string& bytes) const noexcept {
  return send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) ==
         static_cast<ssize_t>(bytes.size());
}

bool TcpStream::read_more(std::string& input, Time end) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
  pollfd wait{socket_, POLLIN, 0};
  const int ready = poll(&wait, 1, static_cast<int>(std::max<long>(left.count(), 0)));
  if (ready < 0 && errno != EINTR) throw ConnectionLost(std::strerror(errno));
  if (ready <= 0) return false;
  char some[4096];
  const ssize_t n = recv(socket_, some, sizeof some, 0);
  if (n == 0) throw ConnectionLost("the other side has closed the connection");
  if (n < 0 && errno == EINTR) return false;
  if (n < 0) throw ConnectionLost(std::strerror(errno));
  input.append(some, static_cast<std::size_t>(n));
  return true;
}

}  // namespace palpate::haptic::kit
