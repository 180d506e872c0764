#include "deploy/lab/packet_port.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/error/error.h"

namespace palpate::lab {
namespace {

constexpr std::size_t longest = 70'000;  // a frame may be as long as the kernel cuts it only later

}  // namespace

PacketPort::PacketPort(const std::string& interface) {
  const unsigned index = if_nametoindex(interface.c_str());
  if (index == 0) throw InputError(fmt::format("{}: no such network interface", interface));
  descriptor_ = socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, htons(ETH_P_ALL));
  if (descriptor_ < 0)
    throw InputError(
        fmt::format("{}: cannot be read ({}); run this as root", interface, std::strerror(errno)));
  sockaddr_ll address = {};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(ETH_P_ALL);
  address.sll_ifindex = static_cast<int>(index);
  sockaddr_storage generic = {};
  std::memcpy(&generic, &address, sizeof address);
  const int yes = 1;
  const int bytes = 8 << 20;
  const bool ready = setsockopt(descriptor_, SOL_PACKET, PACKET_VNET_HDR, &yes, sizeof yes) == 0 &&
                     setsockopt(descriptor_, SOL_PACKET, PACKET_IGNORE_OUTGOING, &yes, sizeof yes) == 0 &&
                     setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes) == 0 &&
                     bind(descriptor_, reinterpret_cast<const sockaddr*>(&generic), sizeof address) == 0;
  if (ready) return;
  const int error = errno;
  close(descriptor_);
  throw InputError(fmt::format("{}: cannot be read frame by frame ({})", interface, std::strerror(error)));
}

PacketPort::~PacketPort() { close(descriptor_); }

bool PacketPort::read(std::vector<std::uint8_t>& frame) {
  frame.resize(longest);
  const auto size = recv(descriptor_, frame.data(), frame.size(), 0);
  if (size <= 0) return false;
  frame.resize(static_cast<std::size_t>(size));
  return true;
}

void PacketPort::write(std::span<const std::uint8_t> frame) {
  if (send(descriptor_, frame.data(), frame.size(), 0) < 0) return;  // as a cable: what does not go is lost
}

}  // namespace palpate::lab
