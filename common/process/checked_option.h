#pragma once
// Numbers of a command line, bounded where they enter. CLI11's own checks let nan through: it is neither below nor above.

#include <CLI/CLI.hpp>

#include "common/scene/range.h"

namespace palpate {

/// Takes one number of `range`, written in full ("2", "0.5", "1e-3"). Anything else, nan and inf among it, is one line:
/// '--seconds: "nan" is out of range; write a number above 0 and at most 1000000'. Infinite ends of a range are not values.
CLI::Validator number_in(const Range& range);

}  // namespace palpate
