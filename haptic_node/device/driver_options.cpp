#include "haptic_node/device/driver_options.h"

#include <fmt/format.h>

namespace palpate::haptic {
namespace {

const char* hand_name(HandModel hand) {
  switch (hand) {
    case HandModel::rigid:
      return "rigid";
    case HandModel::arm:
      return "arm";
    case HandModel::pinch:
      return "pinch";
    case HandModel::firm:
      return "firm";
  }
  return "";
}

std::string waypoint_text(const std::vector<Waypoint>& waypoints, const Calibration& calibration) {
  std::string text;
  for (const auto& waypoint : waypoints) {
    const Vec3 p = calibration.device_from_world(waypoint.p);
    text += fmt::format("{}{:.17g} {:.17g} {:.17g} {:.17g}", text.empty() ? "" : "; ", waypoint.t, p.x(),
                        p.y(), p.z());
  }
  return text;
}

}  // namespace

Device::Options driver_options(const DeviceSpec& spec, const Calibration& calibration,
                               const std::string& driver, std::uint64_t seed) {
  Device::Options options;
  if (driver == spec.driver) options = spec.options;
  if (driver == "simulated") {
    options.emplace_back("hand", hand_name(spec.hand));
    options.emplace_back("seed", std::to_string(seed));
    if (!spec.waypoints.empty())
      options.emplace_back("waypoints", waypoint_text(spec.waypoints, calibration));
  }
  return options;
}

}  // namespace palpate::haptic
