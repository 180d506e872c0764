#pragma once
// A movement from an HDF5 file. A group holds it, in one of two forms:
//
//   t_s (n), p_m (n x 3), perhaps q_wxyz (n x 4), perhaps buttons (n)     written by anybody
//   t_p_force_moment (n x 10)                                             /tools/NAME of the record of a run

#include <string>

#include "haptic_node/drivers/replay/pose_path.h"

namespace palpate::haptic::replay {

inline constexpr std::uint64_t most_poses = 20'000'000;  // refused beyond, before any memory is taken

/// Whether a file is HDF5, whatever its name. @return false for a file that cannot be read, too
bool is_pose_record(const std::string& file);

/// @param group  path of the group; empty: the root, or in a record of a run the only tool
/// @throws kit::Trouble "file: what; what would be right"
PosePath read_pose_record(const std::string& file, const std::string& group);

}  // namespace palpate::haptic::replay
