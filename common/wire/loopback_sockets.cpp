#include "common/wire/loopback_sockets.h"

#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "common/wire/loopback_config.h"

namespace palpate {
namespace {

constexpr std::string_view loopback_name = "lo";

/// Fills `socket` if `descriptor` is an IPv4 UDP socket.
bool look_at(int descriptor, UdpSocket& socket) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_storage storage = {};
  size = sizeof storage;
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return false;
  if (storage.ss_family != AF_INET) return false;
  sockaddr_in address = {};
  std::memcpy(&address, &storage, sizeof address);
  std::array<char, IFNAMSIZ> device = {};
  size = static_cast<socklen_t>(device.size());
  const bool has_device = getsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, device.data(), &size) == 0;
  const std::uint32_t ip = ntohl(address.sin_addr.s_addr);
  socket.descriptor = descriptor;
  socket.port = ntohs(address.sin_port);
  socket.any_address = ip == INADDR_ANY;
  socket.loopback_address = (ip >> 24) == 127;
  socket.loopback_device = has_device && loopback_name == device.data();
  return true;
}

}  // namespace

std::vector<UdpSocket> own_udp_sockets() {
  std::vector<UdpSocket> sockets;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    UdpSocket socket;
    if (look_at(std::atoi(entry.path().filename().c_str()), socket)) sockets.push_back(socket);
  }
  return sockets;
}

bool of_domain(const UdpSocket& socket, int domain) {
  const int last = discovery_port(domain, max_participants) + 1;
  return socket.port >= multicast_port(domain) && socket.port <= last;
}

bool tie_to_loopback(int domain) {
  bool all = true;
  for (const UdpSocket& socket : own_udp_sockets()) {
    if (socket.local_only() || !of_domain(socket, domain)) continue;
    all = setsockopt(socket.descriptor, SOL_SOCKET, SO_BINDTODEVICE, loopback_name.data(),
                     static_cast<socklen_t>(loopback_name.size())) == 0 &&
          all;
  }
  return all;
}

bool hears_loopback_only(int domain) {
  for (const UdpSocket& socket : own_udp_sockets())
    if (of_domain(socket, domain) && !socket.local_only()) return false;
  return true;
}

}  // namespace palpate
