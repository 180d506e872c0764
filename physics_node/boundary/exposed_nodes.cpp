#include "physics_node/boundary/exposed_nodes.h"

namespace palpate::physics {

/// Deep inside the lattice: 12; on voxels 18 of an even mass and 6 of an odd one.
int ExposedNodes::complete_degree(Index node) const noexcept {
  if (lattice_->kind == LatticeKind::fcc) return 12;
  return (lattice_->grid_of(node).sum() & 1) == 0 ? 18 : 6;
}

/// Does space reach this mass although it may lack no element? On fcc where a mass is missing across one of the six octahedra
/// that it is a corner of, on voxels where one of its eight cells is.
bool ExposedNodes::lies_open(Index node) const noexcept {
  if (lattice_->kind != LatticeKind::fcc) return lattice_->mass_share[static_cast<std::size_t>(node)] < 1;
  const Vec3i grid = lattice_->grid_of(node);
  for (int axis = 0; axis < 3; ++axis)
    for (const int by : {-2, 2})
      if (lattice_->mass_at(grid + by * Vec3i::Unit(axis)) < 0) return true;
  return false;
}

}  // namespace palpate::physics
