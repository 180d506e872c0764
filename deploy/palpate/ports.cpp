#include "deploy/palpate/ports.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/error/error.h"
#include "common/wire/loopback_config.h"

namespace palpate::deploy {
namespace {

/// True if a socket of ours could listen there.
bool is_free(int port) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return true;  // no sockets at all: the participant will say so
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  sockaddr generic = {};
  static_assert(sizeof generic == sizeof address);
  std::memcpy(&generic, &address, sizeof address);
  const bool taken = bind(descriptor, &generic, sizeof generic) != 0 && errno == EADDRINUSE;
  close(descriptor);
  return !taken;
}

}  // namespace

std::optional<int> taken_port(int domain) {
  for (int index = 0; index <= max_participants; ++index) {
    const int port = discovery_port(domain, index);
    if (!is_free(port)) return port;
    if (!is_free(port + 1)) return port + 1;
  }
  return {};
}

void require_free_ports(int domain) {
  const auto port = taken_port(domain);
  if (!port) return;
  throw InputError(
      fmt::format("UDP port {} of DDS domain {} is taken, by another session perhaps; end that one or "
                  "choose another domain, for example --domain {}",
                  *port, domain, (domain + 1) % 101));
}

}  // namespace palpate::deploy
