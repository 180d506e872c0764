#pragma once
// Motors off from outside: a process that had the device open has died, another one switches it off.

#include <string>

#include "haptic_node/drivers/openhaptics/hd.h"

namespace palpate::haptic::openhaptics {

/// Opens the device, force output off, a frame without force, releases it. The scheduler stays at rest.
/// @throws kit::Trouble with the vendor's words
void rescue_device(const Hd& hd, const std::string& name);

}  // namespace palpate::haptic::openhaptics
