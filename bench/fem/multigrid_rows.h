#pragma once
// The rows of palpate bench fem that are of implicit steps.

#include <nlohmann/json.hpp>

namespace palpate::bench {

/// V-cycles of all shapes. @param rounds  of each row; the least counts
nlohmann::json cycle_rows(int rounds);
/// Frames of backward_euler beside explicit steps.
nlohmann::json frame_rows();

}  // namespace palpate::bench
