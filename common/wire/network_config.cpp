#include "common/wire/network_config.h"

#include <fmt/format.h>

#include "common/wire/loopback_config.h"

namespace palpate {

std::string network_config(const Route& route) {
  const bool multicast = route.peers.empty();
  std::string peers;
  if (!multicast) {
    // Our own address, too: it is how the nodes of one machine find each other.
    peers = fmt::format("<Peer Address=\"{}\"/>", address_text(route.address));
    for (const auto peer : route.peers) peers += fmt::format("<Peer Address=\"{}\"/>", address_text(peer));
    peers = "<Peers>" + peers + "</Peers>";
  }
  return fmt::format(
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"{}\" "
      "multicast=\"{}\"/></Interfaces>"
      "<AllowMulticast>{}</AllowMulticast><MaxMessageSize>1472B</MaxMessageSize><FragmentSize>1300B</"
      "FragmentSize></General>"
      "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>{}</"
      "MaxAutoParticipantIndex>"
      "<SPDPInterval>1s</SPDPInterval><LeaseDuration>5s</LeaseDuration>{}</Discovery></Domain></CycloneDDS>",
      route.interface, multicast, multicast ? "spdp" : "false", max_participants, peers);
}

}  // namespace palpate
