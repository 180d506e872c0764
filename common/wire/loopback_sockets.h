#pragma once
// Cyclone DDS 0.10 announces itself on the loopback interface only, but its receiving sockets are bound to every
// address of the machine: a stranger on the network could still send it samples. This closes that door.

#include <vector>

namespace palpate {

/// One UDP socket of this process.
struct UdpSocket {
  int descriptor = -1;
  int port = 0;
  bool any_address = false;       // bound to 0.0.0.0
  bool loopback_address = false;  // bound to 127.x.x.x
  bool loopback_device = false;   // tied to the interface lo
  bool local_only() const { return loopback_address || loopback_device; }
};

/// The open IPv4 UDP sockets of this process.
std::vector<UdpSocket> own_udp_sockets();

/// Its port is one that DDS uses in this domain.
bool of_domain(const UdpSocket& socket, int domain);

/// Ties this process's DDS sockets of a domain (known by their port numbers) to the interface lo.
/// @return true if all of them now hear this machine only
bool tie_to_loopback(int domain);

/// Whether they do already.
bool hears_loopback_only(int domain);

}  // namespace palpate
