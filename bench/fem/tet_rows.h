#pragma once
// The rows of `palpate bench fem` that are of tetrahedra.

#include <nlohmann/json.hpp>

#include "bench/machine/result_folder.h"

namespace palpate::bench {

/// Prints and returns what a step costs; also as rows of `table`.
nlohmann::json tet_kernel_rows(int rounds, double roof, Table& table);

/// Prints and returns how far a cantilever is from quadratic bricks.
nlohmann::json tet_beam_rows();

}  // namespace palpate::bench
