#pragma once
// The DDS configuration that palpate uses unless a person gives another: this machine only, no multicast.

#include <string_view>

namespace palpate {

inline constexpr int max_participants =
    32;  // in one domain on one machine: MaxAutoParticipantIndex of the text

/// Cyclone DDS configuration as XML; the same text as deploy/cyclonedds/loopback.xml.
std::string_view loopback_config() noexcept;

/// UDP port to which multicast discovery of a domain goes; multicast data would go to the next one.
constexpr int multicast_port(int domain) noexcept { return 7400 + 250 * domain; }

/// UDP port on which participant number `index` (0, 1, ...) of a domain listens for others; its data port is one more.
/// Source: OMG DDSI-RTPS 2.3, 9.6.1.1, with the default port numbers.
constexpr int discovery_port(int domain, int index) noexcept {
  return multicast_port(domain) + 10 + 2 * index;
}

}  // namespace palpate
