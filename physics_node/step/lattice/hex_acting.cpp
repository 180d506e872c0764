#include "physics_node/step/lattice/hex_acting.h"

#include <algorithm>

namespace palpate::physics {
namespace {

/// Cuts [first, last) down to where keep(n) holds at both ends.
template <class Keep>
void trim(Index& first, Index& last, const Keep& keep) noexcept {
  while (first < last && !keep(first)) ++first;
  while (first < last && !keep(last - 1)) --last;
}

}  // namespace

HexActing::HexActing(const HexGrid& grid)
    : acts_(grid.runs.size(), 1), layers_(grid.layers), slabs_(grid.slabs) {
  slabs_.reserve(most_slabs + 1);
}

void HexActing::follow(const HexGrid& grid, std::span<const RowState> rows,
                       std::span<const std::uint8_t> runs) noexcept {
  std::ranges::copy(runs, acts_.begin());
  for (std::size_t r = 0; runs.empty() && r < grid.runs.size(); ++r) {
    const auto of_run = grid.rows_of(r);
    acts_[r] = std::any_of(of_run.begin(), of_run.end(), [&rows](Index row) {
      const RowState state = rows[static_cast<std::size_t>(row)];
      return state == RowState::awake || state == RowState::rim;
    });
  }
  for (std::size_t n = 0; n < layers_.size(); ++n) {
    HexLayer& layer = layers_[n] = grid.layers[n];
    trim(layer.first_run, layer.last_run, [this](Index r) { return acts(r); });
    trim(layer.first_row, layer.last_row,
         [&rows](Index r) { return rows[static_cast<std::size_t>(r)] != RowState::asleep; });
  }
  share_out(grid, layers_, slabs_);
}

}  // namespace palpate::physics
