#pragma once
// Cyclone DDS sends through the configured interface, but its receiving sockets are bound to every address of
// the machine. This lets the kernel drop what came another way or from another machine.

#include "common/wire/reach.h"

namespace palpate {

/// Attaches a filter to this process's DDS sockets of a domain: a datagram passes if it came from this machine, or
/// through the route's interface and, where the route names peers, with the source address of one of them. Source
/// addresses can be forged: this keeps order among honest machines, it is no lock.
/// Source: Linux Documentation/networking/filter.rst (classic BPF, SKF_AD_IFINDEX, SKF_NET_OFF).
/// @return true if all sockets have it
bool hear_only(int domain, const Route& route);

}  // namespace palpate
