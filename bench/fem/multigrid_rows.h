#pragma once
// The rows of palpate bench fem that are of implicit steps.

#include <nlohmann/json.hpp>

#include "common/scene/shape_spec.h"

namespace palpate::bench {

/// V-cycles of all shapes. @param rounds  of each row; the least counts
nlohmann::json cycle_rows(int rounds);
/// Of the tissue of an image, whose lowest layer is held. @throws InputError if it cannot be read
nlohmann::json cycle_rows_of(const VolumeShape& image, int rounds);
/// Frames of backward_euler beside explicit steps.
nlohmann::json frame_rows();

}  // namespace palpate::bench
