#pragma once
// An image as tissue that a tip can press: which intensities it has, in cells of which size, and which of them are
// filled.

#include <array>
#include <optional>
#include <string>

#include "common/record/volume.h"
#include "physics_node/body/cells.h"

namespace palpate::deploy {

/// @throws InputError  no such file, or no volume that palpate import has written
void check_volume(const std::string& path);
/// @param bytes_a_cell  that the reader's work takes at most  @throws InputError  more memory than may be taken
Volume read_volume_within_memory(const std::string& path, double bytes_a_cell);

struct KeepWindow {
  double lo = 0, hi = 0;  // intensities of tissue, both ends included
};

struct ImageTissue {
  KeepWindow keep;
  std::array<int, 3> partition{};
  physics::Cells
      cells;  // of the partition: the largest part of the tissue, the middle of the image in the origin; nothing of it deforms
  double tip_radius = 0;  // that suits it: the cells follow it [m]
};

/// @param keep  instead of what the histogram says
/// @param path  of the volume, for messages
/// @throws InputError  no tissue, no air, or too few cells of tissue
/// Cost: some passes over the image, twice its memory.
ImageTissue find_tissue(const Volume& volume, const std::optional<KeepWindow>& keep, const std::string& path);

}  // namespace palpate::deploy
