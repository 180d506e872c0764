#pragma once
// What it costs to tell a hand a body by a few modes, and how true that is.

#include <nlohmann/json.hpp>

namespace palpate::bench {

/// Prints and returns, for a block of 10 kPa and a patch of 5 mm on it: time of the modes and of a contact, and the error of the compliance
/// at 5 to 30 Hz by 3, 9 and 20 modes against 60, with the residual and without. (Against exact matrices: driving_point_test.)
nlohmann::json reduced_rows();

}  // namespace palpate::bench
