#pragma once
// Rows of palpate bench fem about lumps.

#include <nlohmann/json.hpp>

namespace palpate::bench {

/// @param rounds  of each row; the median counts
nlohmann::json lump_rows(int rounds);

}  // namespace palpate::bench
