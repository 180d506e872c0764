#pragma once
// [device.NAME] of a scene.

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/place.h"

namespace palpate {

struct Waypoint {
  double t = 0;           // [s]
  Vec3 p = Vec3::Zero();  // world [m]
};
enum class HandModel { rigid, arm, pinch, firm };

struct DeviceSpec {
  std::string name;
  std::string driver;
  double rate_Hz = 1000;
  double force_limit = 3.0;                                // [N]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // R_WD, det +1
  double scale = 1.0;                                      // world metres per device metre
  double force_scale = 1.0;                                // device newtons per world newton
  Vec3 offset = Vec3::Zero();                              // [m]
  std::vector<Waypoint> waypoints;                         // "simulated": in the world frame
  HandModel hand = HandModel::arm;                         // "simulated"
  /// Other keys, passed to the driver as text; "simulated": model.
  std::vector<std::pair<std::string, std::string>> options;
  Place place;
};

}  // namespace palpate
