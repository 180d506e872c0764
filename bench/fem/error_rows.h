#pragma once
// Error against CPU time of answers at rest: a cantilever under its weight and a block under a sphere.

#include <nlohmann/json.hpp>

namespace palpate::bench {

/// Runs and prints them; where CalculiX is not installed its rows and those of springs, which need its reference, are left out and
/// it says so.
nlohmann::json error_rows();

}  // namespace palpate::bench
