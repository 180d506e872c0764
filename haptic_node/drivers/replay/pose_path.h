#pragma once
// A recorded movement: poses at times, read from a table in a text file.

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

struct PosePath {
  std::vector<Pose> poses;  // times grow; never empty
  bool has_attitude = false;
  bool has_buttons = false;

  /// Linear in between, attitudes on the shortest arc, buttons of the pose before; at rest outside.
  /// @param hint  where the search begins; set to where it ended
  Pose at(double t, std::size_t& hint) const noexcept;
  double duration() const noexcept { return poses.back().t - poses.front().t; }
};

/// A table, its fields between commas or, without any comma, between blanks. Its first line names the columns, in any order: t_s, x_mm y_mm z_mm (or x_m y_m z_m), and
/// perhaps qw qx qy qz, and perhaps buttons. Other columns are left alone, so that the traces of a run can be played.
/// Empty lines and lines that begin with # are skipped.
/// @throws kit::Trouble "file:line:column: what; what would be right"
PosePath read_pose_path(const std::string& file);

}  // namespace palpate::haptic::replay
