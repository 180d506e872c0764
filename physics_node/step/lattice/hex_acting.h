#pragma once
// Which cells of a grid act while rows of masses sleep: cost follows what moves.

#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/step/lattice/element_context.h"
#include "physics_node/step/lattice/hex_grid.h"

namespace palpate::physics {

/// A run acts if one of its corners lies in a row that is awake, or in a rim, whose watch needs all cells around it. Layers are cut
/// down to what acts and to rows that are not asleep, and slabs share that out anew; which they are changes no bit.
class HexActing {
 public:
  explicit HexActing(const HexGrid& grid);

  /// Cost: what exists, so only when rows have changed. Contract: allocates nothing.
  /// @param runs  1: acts, of a body that is awake in parts; else EMPTY, and rows decide
  void follow(const HexGrid& grid, std::span<const RowState> rows,
              std::span<const std::uint8_t> runs) noexcept;

  bool acts(Index run) const noexcept { return acts_[static_cast<std::size_t>(run)] != 0; }
  const std::uint8_t* flags() const noexcept { return acts_.data(); }  // by run, 1: acts
  std::span<const HexLayer> layers() const noexcept { return layers_; }
  std::span<const HexSlab> slabs() const noexcept { return slabs_; }

 private:
  std::vector<std::uint8_t> acts_;
  std::vector<HexLayer> layers_;
  std::vector<HexSlab> slabs_;
};

}  // namespace palpate::physics
