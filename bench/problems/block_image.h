#pragma once
// A block of tissue in an image that is made for a benchmark.

#include <array>
#include <string>

namespace palpate::bench {

/// Tissue is positive, with two cells of air around. What was there is overwritten. @param cells  of tissue, along x, y, z
/// @param edge  of a cell [m] @throws InputError  it cannot be written
void write_block_image(const std::array<int, 3>& cells, double edge, const std::string& path);

}  // namespace palpate::bench
