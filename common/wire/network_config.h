#pragma once
// The DDS configuration of a session across machines: one interface, and either a list of peers or multicast to find
// each other. Data always goes from machine to machine.

#include <string>

#include "common/wire/reach.h"

namespace palpate {

/// Cyclone DDS configuration as XML. Datagrams fit one Ethernet frame, so that a lost frame costs no more than itself.
std::string network_config(const Route& route);

}  // namespace palpate
