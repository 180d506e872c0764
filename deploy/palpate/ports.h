#pragma once
// Is another session in this DDS domain already? Its UDP ports tell.

#include <optional>

namespace palpate::deploy {

/// The first UDP port of the domain that is taken on this machine; nothing if all are free.
std::optional<int> taken_port(int domain);

/// @throws InputError naming the port and advising --domain
void require_free_ports(int domain);

}  // namespace palpate::deploy
