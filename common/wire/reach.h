#pragma once
// With which machines a process talks: with its own only, or through one network interface with the machines behind it.

#include <cstdint>
#include <string>
#include <vector>

namespace palpate {

/// As a person says it.
struct Reach {
  std::string interface;  // name or IPv4 address of one of this machine; empty: see peers
  std::vector<std::string>
      peers;  // other machines, by name or IPv4 address; empty: whoever answers a multicast
  /// Neither is given, or the interface is the loopback one: nothing leaves this machine.
  bool local() const;
};

/// As the network knows it.
struct Route {
  std::string interface = "lo";
  unsigned index = 1;                // of the interface in the kernel
  std::uint32_t address = 0;         // of this machine there, host byte order
  std::vector<std::uint32_t> peers;  // host byte order; empty: multicast
};

/// Finds the interface, or the one through which the first peer is reached, and the addresses of the peers (which may
/// ask a name server).
/// @throws InputError that lists what interfaces there are, or names the peer that cannot be found
Route resolve(const Reach& reach);

/// "10.0.0.1" of 0x0a000001.
std::string address_text(std::uint32_t address);

/// From "a,b"; empty words are left out.
std::vector<std::string> comma_list(const std::string& text);

}  // namespace palpate
