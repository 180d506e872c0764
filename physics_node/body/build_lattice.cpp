#include "physics_node/body/build_lattice.h"

#include <algorithm>

namespace palpate::physics {
namespace {

struct CellBox {
  Vec3i lo, hi;
};

CellBox moving_box(const Cells& cells) {
  CellBox box{cells.size, Vec3i::Constant(-1)};
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        if (cells.share_of(i, j, k) == 0) continue;
        box.lo = box.lo.cwiseMin(Vec3i(i, j, k));
        box.hi = box.hi.cwiseMax(Vec3i(i, j, k));
      }
  return box;
}

/// Sets the bits of every element whose two ends are masses and for which `holds(grid, direction)` says yes.
template <class Holds>
void join_elements(Lattice& lattice, const Holds& holds) {
  const auto directions = half_directions(lattice.kind);
  for (const Index cell : lattice.masses) {
    const Vec3i grid = lattice.grid_of(cell);
    const auto kind = static_cast<std::size_t>(lattice.row_kind(cell));
    for (std::size_t d = 0; d < directions.size(); ++d) {
      const auto other = static_cast<std::size_t>(cell + lattice.offset[kind][d]);
      if (lattice.mass_share[other] <= 0 || !holds(grid, d)) continue;
      auto& mine = lattice.mask[static_cast<std::size_t>(cell)];
      auto& theirs = lattice.mask[other];
      mine = static_cast<Mask>(mine | (1U << d));
      theirs = static_cast<Mask>(theirs | (1U << (d + directions.size())));
    }
  }
}

}  // namespace

Lattice voxel_lattice(const Cells& cells) {
  const CellBox box = moving_box(cells);
  const Vec3 origin = cells.corner + cells.spacing.cwiseProduct(box.lo.cast<double>());
  Lattice lattice =
      make_lattice(LatticeKind::voxel, box.hi - box.lo + Vec3i::Constant(2), origin, cells.spacing);
  for (int k = box.lo.z(); k <= box.hi.z(); ++k)
    for (int j = box.lo.y(); j <= box.hi.y(); ++j)
      for (int i = box.lo.x(); i <= box.hi.x(); ++i) {
        if (cells.share_of(i, j, k) == 0) continue;
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3i at = Vec3i(i, j, k) - box.lo + Vec3i(corner & 1, corner >> 1 & 1, corner >> 2);
          float& share = lattice.mass_share[static_cast<std::size_t>(lattice.cell_of(at))];
          if (cells.is_deformable(i, j, k))
            share = (share <= share_beyond ? 0.0F : share) + 0.125F;
          else
            share = std::max(share, share_beyond);
        }
      }
  index_masses(lattice);

  // An edge in direction d from grid point g lies in the cells g + min(d, 0) - s, where s runs over the axes that d
  // leaves out. Diagonals join even points.
  const auto directions = half_directions(LatticeKind::voxel);
  join_elements(lattice, [&](const Vec3i& grid, std::size_t d) {
    const Vec3i along = directions[d];
    if (along.cwiseAbs().sum() == 2 && (grid.sum() & 1) != 0) return false;
    for (int s = 0; s < 8; ++s) {
      const Vec3i back(s & 1, s >> 1 & 1, s >> 2);
      if (back.cwiseProduct(along) != Vec3i::Zero()) continue;
      const Vec3i at = grid + box.lo + along.cwiseMin(0) - back;
      if (cells.is_deformable(at.x(), at.y(), at.z())) return true;
    }
    return false;
  });
  return lattice;
}

Vec3i lattice_corner(const Cells& cells, const Lattice& lattice) {
  return ((lattice.origin - cells.corner).array() / cells.spacing.array()).round().cast<int>();
}

bool touches_rigid_cell(const Cells& cells, const Lattice& lattice, Index cell) {
  const Vec3i at = lattice_corner(cells, lattice) + lattice.grid_of(cell);
  for (int s = 0; s < 8; ++s) {
    const int i = at.x() - (s & 1);
    const int j = at.y() - (s >> 1 & 1);
    const int k = at.z() - (s >> 2);
    if (cells.is_filled(i, j, k) && !cells.is_deformable(i, j, k)) return true;
  }
  return false;
}

}  // namespace palpate::physics
