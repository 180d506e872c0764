#pragma once
// A shape as filled cells: what a voxel body is made from, and what stays as rigid scenery.

#include <array>
#include <cstdint>
#include <vector>

#include "common/math/vec3.h"
#include "common/record/volume.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

struct SkinCrossing {
  std::uint64_t face = 0;  // 6 times the number of the filled cell, and which of its faces: -x +x -y +y -z +z
  double share = 0;        // of the way from its centre to that of the empty one
};

struct Cells {
  Vec3i size = Vec3i::Zero();
  Vec3 spacing = Vec3::Zero();           // [m]
  Vec3 corner = Vec3::Zero();            // of cell (0, 0, 0), world [m]
  std::vector<std::uint8_t> filled;      // 1: tissue                              (size, x fastest)
  std::vector<std::uint8_t> deformable;  // 1: tissue that moves; the rest is rigid (size)
  /// How much of each cell that moves is tissue, of cells not seen, too, that the shape reaches into; EMPTY: all of the deformable ones
  /// (border_cells.h).                                                             (size)
  std::vector<float> share;
  /// Where the tissue ends between the centres of a filled cell and of an empty one beside it; EMPTY: its faces are
  /// its skin (skin_crossings.h).                                                            (by `face`)
  std::vector<SkinCrossing> crossings;
  std::vector<float> intensity;         // of each cell; empty where there is no image
  std::vector<TransferPoint> transfer;  // colours; empty where there is no image

  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size.x()) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size.y()) * static_cast<std::size_t>(k));
  }
  Vec3i cell_of(std::size_t index) const {
    const auto nx = static_cast<std::size_t>(size.x()), ny = static_cast<std::size_t>(size.y());
    return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
            static_cast<int>(index / nx / ny)};
  }
  bool inside(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size.x() && j < size.y() && k < size.z();
  }
  bool is_filled(int i, int j, int k) const { return inside(i, j, k) && filled[index(i, j, k)] != 0; }
  bool is_deformable(int i, int j, int k) const { return inside(i, j, k) && deformable[index(i, j, k)] != 0; }
  /// How much of a cell moves: 0 of one that does not.
  float share_of(int i, int j, int k) const {
    if (share.empty()) return is_deformable(i, j, k) ? 1.0F : 0.0F;
    return inside(i, j, k) ? share[index(i, j, k)] : 0.0F;
  }
  /// The cell that a place in the world lies in, which need not be inside.
  Vec3i cell_at(const Vec3& p) const { return ((p - corner).array() / spacing.array()).floor().cast<int>(); }
  Vec3 centre_of(int i, int j, int k) const {
    return corner + spacing.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
  }
  std::size_t n_filled() const;
  std::size_t n_deformable() const;
};

/// The cells of a body's shape. A volume is read from its file or its slices, resampled to the partition asked for, and
/// thresholded; other shapes fill every cell whose centre lies inside, and of a tube with wall_layers so many from the outside
/// in. Cells whose centre lies in a cavity are empty. The axes of the image are those of the world,
/// but x is turned round where they are left-handed; center_voxel counts as the image does.
/// @throws InputError: unreadable volume, nothing left within the window, a cavity that takes nothing, nothing deformable
Cells make_cells(const BodySpec& body);

/// Keeps only the largest 6-connected component of `filled`. @return how many components there were
int keep_largest_component(Cells& cells);
/// How many 6-connected pieces the filled cells are.
int n_pieces(const Cells& cells);

}  // namespace palpate::physics
