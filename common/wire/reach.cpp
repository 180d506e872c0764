#include "common/wire/reach.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <sstream>

#include "common/error/error.h"

namespace palpate {
namespace {

struct Interface {
  std::string name;
  std::uint32_t address = 0;
};

std::uint32_t address_of(const sockaddr* generic) {
  sockaddr_in address = {};
  std::memcpy(&address, generic, sizeof address);
  return ntohl(address.sin_addr.s_addr);
}

/// Those that are up and have an IPv4 address.
std::vector<Interface> interfaces_here() {
  std::vector<Interface> found;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return found;
  for (const ifaddrs* at = list; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET || (at->ifa_flags & IFF_UP) == 0)
      continue;
    found.push_back({at->ifa_name, address_of(at->ifa_addr)});
  }
  freeifaddrs(list);
  return found;
}

std::uint32_t find_peer(const std::string& name) {
  addrinfo hints = {};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* list = nullptr;
  const int error = getaddrinfo(name.c_str(), nullptr, &hints, &list);
  if (error != 0) {
    throw InputError(
        fmt::format("--peers: \"{}\" cannot be found ({}); give the IPv4 address of the other PC", name,
                    gai_strerror(error)));
  }
  const std::uint32_t address = address_of(list->ai_addr);
  freeaddrinfo(list);
  return address;
}

/// Our address on the way to a peer, as the routing table has it; nothing is sent.
std::optional<std::uint32_t> source_towards(std::uint32_t peer) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return {};
  sockaddr_in to = {};
  to.sin_family = AF_INET;
  to.sin_port = htons(7410);
  to.sin_addr.s_addr = htonl(peer);
  sockaddr generic = {};
  static_assert(sizeof generic == sizeof to);
  std::memcpy(&generic, &to, sizeof to);
  socklen_t size = sizeof generic;
  const bool known =
      connect(descriptor, &generic, sizeof generic) == 0 && getsockname(descriptor, &generic, &size) == 0;
  close(descriptor);
  if (!known) return {};
  return address_of(&generic);
}

Interface find_interface(const Reach& reach, const std::vector<std::uint32_t>& peers) {
  const auto here = interfaces_here();
  std::optional<std::uint32_t> towards;
  if (reach.interface.empty()) {
    towards = source_towards(peers.front());
    if (!towards)
      throw InputError(fmt::format("--peers: no way leads to {}; is the cable in and the address right?",
                                   reach.peers.front()));
  }
  const auto found = std::find_if(here.begin(), here.end(), [&](const Interface& one) {
    return towards ? one.address == *towards
                   : one.name == reach.interface || address_text(one.address) == reach.interface;
  });
  if (found != here.end()) return *found;
  std::vector<std::string> names;
  for (const Interface& one : here)
    names.push_back(fmt::format("{} ({})", one.name, address_text(one.address)));
  throw InputError(
      fmt::format("--interface: \"{}\" is no interface that is up with an IPv4 address; choose from {}",
                  reach.interface, fmt::join(names, ", ")));
}

}  // namespace

bool Reach::local() const {
  return (interface.empty() && peers.empty()) || interface == "lo" || interface.starts_with("127.");
}

std::string address_text(std::uint32_t address) {
  return fmt::format("{}.{}.{}.{}", address >> 24, (address >> 16) & 255, (address >> 8) & 255,
                     address & 255);
}

std::vector<std::string> comma_list(const std::string& text) {
  std::vector<std::string> words;
  std::stringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');)
    if (!word.empty()) words.push_back(word);
  return words;
}

Route resolve(const Reach& reach) {
  Route route;
  route.index = if_nametoindex("lo");
  if (reach.local()) return route;
  for (const std::string& peer : reach.peers) route.peers.push_back(find_peer(peer));
  const Interface interface = find_interface(reach, route.peers);
  route.interface = interface.name;
  route.index = if_nametoindex(interface.name.c_str());
  route.address = interface.address;
  return route;
}

}  // namespace palpate
