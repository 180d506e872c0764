#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "common/error/error.h"
#include "common/wire/loopback_sockets.h"
#include "common/wire/reader.h"
#include "common/wire/shared_memory.h"
#include "common/wire/writer.h"
#include "deploy/palpate/doctor.h"
#include "deploy/palpate/ports.h"

namespace palpate::deploy {
namespace {

using namespace std::chrono_literals;

/// A DDS domain with no session in it, so that the check disturbs nobody.
std::optional<int> quiet_domain() {
  for (int domain = 100; domain >= 0; --domain) {
    if (!taken_port(domain)) return domain;
  }
  return {};
}

bool message_passes(Participant& participant) {
  Writer<Command> writer(participant);
  Reader<Command> reader(participant);
  Command command;
  const auto end = std::chrono::steady_clock::now() + 2s;
  while (std::chrono::steady_clock::now() < end) {
    writer.write(command);
    if (reader.wait(20ms) && reader.take(command)) return true;
  }
  return false;
}

std::string open_ports() {
  std::string ports;
  for (const UdpSocket& socket : own_udp_sockets()) {
    if (!socket.local_only()) ports += fmt::format(" {}", socket.port);
  }
  return ports;
}

}  // namespace

Finding check_wire() {
  const auto domain = quiet_domain();
  if (!domain) return {"DDS", Finding::State::fails, "all domains are taken; end other sessions"};
  try {
    Participant participant(*domain);
    if (!message_passes(participant)) {
      return {"DDS", Finding::State::fails,
              "no message came through loopback in 2 s; check that the interface lo is up"};
    }
    if (participant.local_only())
      return {"DDS", Finding::State::ok, "messages pass, and only this machine is heard"};
    if (std::getenv("CYCLONEDDS_URI") != nullptr) {
      return {"DDS", Finding::State::ok,
              "messages pass, configured by CYCLONEDDS_URI; open ports:" + open_ports()};
    }
    return {"DDS", Finding::State::lacks,
            "messages pass, but strangers are heard on UDP ports" + open_ports() +
                "; close them in the firewall"};
  } catch (const std::exception& error) {
    return {"DDS", Finding::State::fails, error.what()};
  }
}

Finding check_shared_memory() {
  const RouDi found = look_for_roudi();
  const bool in_the_way = found == RouDi::unreachable || found == RouDi::watching;
  return {"shared memory", in_the_way ? Finding::State::lacks : Finding::State::ok, words(found)};
}

}  // namespace palpate::deploy
