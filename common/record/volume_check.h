#pragma once
// What every image must satisfy, wherever it came from. `where` begins the complaint: the file's name.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "common/record/volume.h"

namespace palpate {

/// The sizes as ints. @throws InputError: a size below 1, or more cells than volume_cells_limit
std::array<int, 3> check_size(const std::string& where, const std::array<std::int64_t, 3>& size);

/// @throws InputError: not finite, zero, negative, or beyond 1 m a cell
void check_spacing(const std::string& where, const Eigen::Vector3d& spacing);

/// @throws InputError: a value that is not finite
void check_intensity(const std::string& where, const std::vector<float>& intensity);

/// @throws InputError: fewer than two points, not sorted, colours outside 0..1
void check_transfer(const std::string& where, const std::vector<TransferPoint>& transfer);

}  // namespace palpate
