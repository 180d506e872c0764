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
                               const std::string& driver, const DriverPlace& place) {
  Device::Options options;
  if (driver == spec.driver) options = spec.options;
  if (driver == "simulated") {
    options.emplace_back("hand", hand_name(spec.hand));
    options.emplace_back("seed", std::to_string(place.seed));
    if (!spec.waypoints.empty())
      options.emplace_back("waypoints", waypoint_text(spec.waypoints, calibration));
  }
  if (driver == "mouse") {
    const Eigen::Matrix3d& r = calibration.rotation();
    std::string rows;
    for (Eigen::Index i = 0; i < 3; ++i)
      rows += fmt::format("{:.17g} {:.17g} {:.17g} ", r(i, 0), r(i, 1), r(i, 2));
    const Vec3 o = calibration.world_from_device(Vec3::Zero());
    if (place.domain >= 0) options.emplace_back("domain", std::to_string(place.domain));
    options.emplace_back("tool", std::to_string(place.tool));
    options.emplace_back("world_rotation", rows);
    options.emplace_back("world_scale", fmt::format("{:.17g}", calibration.scale()));
    options.emplace_back("world_offset_m", fmt::format("{:.17g} {:.17g} {:.17g}", o.x(), o.y(), o.z()));
  }
  return options;
}

}  // namespace palpate::haptic
