#pragma once
// A recorded movement: poses at times. pose_table.h reads one from text, pose_record.h from HDF5.

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace palpate::haptic::replay {

struct Pose {
  double t = 0;                                           // [s]
  Eigen::Vector3d p = Eigen::Vector3d::Zero();            // [m]
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  // handle to device
  std::uint32_t buttons = 0;                              // bit i: button i
};

inline constexpr std::uint32_t most_buttons = 65535;

struct PosePath {
  std::vector<Pose> poses;  // times grow; never empty once read
  bool has_attitude = false;
  bool has_buttons = false;

  /// Appends a pose whose time is later, with finite numbers and a unit attitude (within 1e-3).
  /// @return what is wrong with it, and what would be right; empty: it was taken
  std::string take(Pose pose);

  /// Linear in between, attitudes on the shortest arc, buttons of the pose before; at rest outside.
  /// @param hint  where the search begins; set to where it ended
  Pose at(double t, std::size_t& hint) const noexcept;
  double duration() const noexcept { return poses.back().t - poses.front().t; }
};

}  // namespace palpate::haptic::replay
