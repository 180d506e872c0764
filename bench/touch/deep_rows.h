#pragma once
// A sphere pressed 5 mm deep: how force depends on the cells, and whether any cell or corner is turned inside out.

#include <nlohmann/json.hpp>

namespace palpate::bench {

/// Prints and returns a row for radii of 3, 5 and 8 mm, nu 0.45 and 0.49. @param finest  also cells of 0.83 mm, an hour or more
nlohmann::json deep_rows(bool finest);

}  // namespace palpate::bench
