#pragma once
// Slices of a brain made by formulas, for those who have no patient's.

#include <string>
#include <vector>

#include "common/record/png_file.h"

namespace palpate {

inline constexpr int brain_width = 96, brain_height = 112, brain_planes = 48;  // [px], [px], slices
inline constexpr double brain_pixel_mm = 1.8, brain_plane_mm = 3.5;

/// Two hemispheres, 136 x 168 x 124 mm, divided above a corpus callosum and folded into gyri; white matter (about 200) under a
/// cortex of grey (about 130), ventricles and everything round it dark, a cerebellum and a stem below and behind. The top of a
/// slice is the front, the first slice the lowest. Keep 90 to 255 for the tissue, from 165 on for white matter.
/// The same bits every time.
std::vector<GreyPicture> brain_phantom();

/// Writes them to folder/slice_00.png ... slice_47.png; makes the folder if its parent is there.
/// @throws InputError: no such parent, not a folder, cannot be written
void write_brain_phantom(const std::string& folder);

}  // namespace palpate
