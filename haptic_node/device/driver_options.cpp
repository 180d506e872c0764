#include "haptic_node/device/driver_options.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>

#include "common/error/error.h"
#include "common/scene/device_spec.h"

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

/// Attitudes "t w x y z; ..." of the scene, from the world to the frame of the device: R_d = R^T R_w. Not turned where the scene
/// gives none.
std::string attitude_text(const std::string& in_world, const Calibration& calibration) {
  const Eigen::Quaterniond to_device = Eigen::Quaterniond(calibration.rotation()).conjugate();
  std::istringstream list(in_world);
  std::string text;
  for (std::string item; std::getline(list, item, ';');) {
    std::istringstream fields(item);
    double t = 0, w = 1, x = 0, y = 0, z = 0;
    PALPATE_CHECK(fields >> t >> w >> x >> y >> z, "an attitude as read_devices writes it");
    const Eigen::Quaterniond q = (to_device * Eigen::Quaterniond(w, x, y, z)).normalized();
    text += fmt::format("{}{:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", text.empty() ? "" : "; ", t, q.w(),
                        q.x(), q.y(), q.z());
  }
  return text;
}

/// Of a hand that turns, which says so by `attitudes` or `max_torque`.
void turn_to_device(Device::Options& options, const Calibration& calibration) {
  const auto find = [&](const char* key) {
    return std::find_if(options.begin(), options.end(), [&](const auto& pair) { return pair.first == key; });
  };
  if (const auto attitudes = find("attitudes"); attitudes != options.end())
    attitudes->second = attitude_text(attitudes->second, calibration);
  else if (find("max_torque") != options.end())
    options.emplace_back("attitudes", attitude_text("0 1 0 0 0", calibration));
}

}  // namespace

Device::Options driver_options(const DeviceSpec& spec, const Calibration& calibration,
                               const std::string& driver, const DriverPlace& place) {
  Device::Options options;
  if (driver == spec.driver) options = spec.options;
  if (driver == "simulated") {
    options.emplace_back("hand", hand_name(spec.hand));
    options.emplace_back("seed", std::to_string(place.seed));
    turn_to_device(options, calibration);
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
