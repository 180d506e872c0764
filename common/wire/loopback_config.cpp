#include "common/wire/loopback_config.h"

namespace palpate {

std::string_view loopback_config() noexcept {
  return R"(<CycloneDDS>
  <Domain Id="any">
    <General>
      <Interfaces>
        <NetworkInterface name="lo" multicast="false"/>
      </Interfaces>
      <AllowMulticast>false</AllowMulticast>
      <MaxMessageSize>65500B</MaxMessageSize>
    </General>
    <Discovery>
      <ParticipantIndex>auto</ParticipantIndex>
      <MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>
      <SPDPInterval>1s</SPDPInterval>
      <LeaseDuration>5s</LeaseDuration>
      <Peers>
        <Peer Address="127.0.0.1"/>
      </Peers>
    </Discovery>
  </Domain>
</CycloneDDS>
)";
}

}  // namespace palpate
