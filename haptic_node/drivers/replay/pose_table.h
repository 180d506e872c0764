#pragma once
// A movement from a table in a text file.

#include <string>

#include "haptic_node/drivers/replay/pose_path.h"

namespace palpate::haptic::replay {

/// What a .traj file of Ruffaldi et al. 2006 is taken to hold where nobody says so; what follows is left alone.
inline constexpr const char* traj_columns = "t_s x_mm y_mm z_mm";

/// A table, its fields between commas or, without any comma, between blanks. Empty lines and lines that begin with # are
/// skipped.
/// @param columns  names of the columns, between blanks or commas: t_s (or t_ms), x_mm y_mm z_mm (or x_m y_m z_m), perhaps
///                 qw qx qy qz, perhaps buttons, in any order; other columns are left alone. Empty: the first line names
///                 them. Else the table has no such line, and may have further columns.
/// @throws kit::Trouble "file:line:column: what; what would be right"
PosePath read_pose_table(const std::string& file, const std::string& columns);

}  // namespace palpate::haptic::replay
