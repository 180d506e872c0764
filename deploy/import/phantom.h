#pragma once
// An image made by formulas, for those who have no patient's: an angiogram of vessels with a saccular aneurysm.

#include <array>

#include "common/record/volume.h"

namespace palpate {

/// Cells of the whole phantom: 161 x 161 x 84 mm of a time-of-flight MR angiogram.
inline constexpr std::array<int, 3> phantom_size{336, 336, 140};

/// Bright vessels (about 400) in dark tissue (about 60), smooth at their walls as partial volumes are, with mild noise.
/// A curved parent vessel passes under a sac of 13 x 13 x 10 mm and two branches rise from its neck; everything but noise
/// and one small bleb looks the same after half a turn about z, so that the centre of gravity lies in the sac.
/// Spacing 0.48 x 0.48 x 0.6 mm whatever the size: another size is cut from, or adds to, the same image round its
/// middle, cell by cell. Keep 220 and more for the vessels. The same bits every time.
/// @throws InputError: absurd size
Volume aneurysm_phantom(std::array<int, 3> size);

}  // namespace palpate
