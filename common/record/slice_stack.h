#pragma once
// Pictures of parallel planes become a volume.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/record/volume.h"

namespace palpate {

/// A volume of one cell a pixel: x along the rows of a picture, y from its last row up to its first, z from the first file to
/// the last, so that from +z it looks as on the screen. Its intensity is the grey of the pixel (png_file.h).
/// @param files    PNG, in order, at least one
/// @param spacing  of cells along x, y, z [m]
/// @throws InputError: a file that cannot be read, another size or depth than the first, too many cells in all
Volume read_slices(const std::vector<std::string>& files, const Eigen::Vector3d& spacing);

}  // namespace palpate
