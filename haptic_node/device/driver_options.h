#pragma once
// What a scene says about a device, as the keys and values that its driver understands.

#include <cstdint>
#include <string>

#include "common/scene/scene.h"
#include "haptic_node/device/calibration.h"
#include "haptic_node/device/device.h"

namespace palpate::haptic {

/// The keys that the scene gives for its own driver are passed on as they stand; with another driver in its place
/// (`driver` differs from spec.driver) they are left out. The simulated hand also gets `hand`, `seed` and
/// `waypoints`, "t x y z; ..." in seconds and metres of the device's frame.
Device::Options driver_options(const DeviceSpec& spec, const Calibration& calibration,
                               const std::string& driver, std::uint64_t seed);

}  // namespace palpate::haptic
