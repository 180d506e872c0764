#pragma once
// What a scene says about a device, as the keys and values that its driver understands.

#include <cstdint>
#include <string>

#include "common/scene/scene_fwd.h"
#include "haptic_node/device/calibration.h"
#include "haptic_node/device/device.h"

namespace palpate::haptic {

/// Where a driver finds itself.
struct DriverPlace {
  std::uint64_t seed = 0;  // of the scene
  std::uint32_t tool = 0;  // index in the scene
  int domain = -1;         // DDS; below 0: none, as in simulated time
};

/// The keys that the scene gives for its own driver are passed on as they stand; with another driver in its place
/// (`driver` differs from spec.driver) they are left out. The simulated hand also gets `hand`, `seed`,
/// `waypoints`, "t x y z; ..." in seconds and metres of the device's frame, and, if it turns, `attitudes`, "t w x y z; ..." as
/// quaternions from handle to device. The mouse gets what it cannot know from its
/// window: `domain` (unless below 0: no window), `tool`, and the calibration, as it points in the world.
Device::Options driver_options(const DeviceSpec& spec, const Calibration& calibration,
                               const std::string& driver, const DriverPlace& place);

}  // namespace palpate::haptic
