#include "common/wire/socket_filter.h"

#include <linux/filter.h>
#include <net/if.h>
#include <sys/socket.h>

#include <vector>

#include "common/wire/loopback_config.h"
#include "common/wire/loopback_sockets.h"

namespace palpate {
namespace {

constexpr std::uint32_t source_offset = 12;  // of the source address in an IPv4 header
constexpr std::uint32_t whole = 0xffffffff;  // bytes to let pass

sock_filter load(std::uint32_t from) { return {BPF_LD | BPF_W | BPF_ABS, 0, 0, from}; }
sock_filter give(std::uint32_t bytes) { return {BPF_RET | BPF_K, 0, 0, bytes}; }
/// Skips so many instructions when the loaded word is equal to `value`, and when it is not.
sock_filter compare(std::uint32_t value, std::uint8_t equal, std::uint8_t other) {
  return {BPF_JMP | BPF_JEQ | BPF_K, equal, other, value};
}

std::vector<sock_filter> program_for(const Route& route) {
  const auto interface_index = static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_IFINDEX);
  const auto source = static_cast<std::uint32_t>(SKF_NET_OFF) + source_offset;
  std::vector<sock_filter> program = {load(interface_index), compare(if_nametoindex("lo"), 0, 1), give(whole),
                                      compare(route.index, 1, 0), give(0)};
  if (route.peers.empty()) {
    program.push_back(give(whole));
    return program;
  }
  program.push_back(load(source));
  for (const std::uint32_t peer : route.peers) {
    program.push_back(compare(peer, 0, 1));
    program.push_back(give(whole));
  }
  program.push_back(give(0));
  return program;
}

}  // namespace

bool hear_only(int domain, const Route& route) {
  std::vector<sock_filter> program = program_for(route);
  const sock_fprog filter = {static_cast<unsigned short>(program.size()), program.data()};
  bool all = true;
  for (const UdpSocket& socket : own_udp_sockets()) {
    if (!of_domain(socket, domain)) continue;
    all = setsockopt(socket.descriptor, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0 && all;
  }
  return all;
}

}  // namespace palpate
