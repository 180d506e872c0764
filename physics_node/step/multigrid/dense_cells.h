#pragma once
// Coarse cells that contain held nodes: their stiffness is that of their parts, not that of a cell of their size.

#include <span>

#include "physics_node/step/fem/hex_stiffness.h"
#include "physics_node/step/multigrid/coarsen.h"

namespace palpate::physics {

/// A cell with a stiffness of its own, at rest.
struct DenseCell {
  Index cell = 0;
  HexMatrix stiffness;  // [N/m]
};

/// K = sum over the parts of Q^T K_part Q, Q trilinear and without what is held. What a held node holds does not move in such a
/// cell, even where its corners are free: held nodes seldom lie on the coarse lattice.
/// @param unit  stiffness of a fine cell of the body's own modulus [N/m]
/// @return of the coarse level, in the order of its cells
std::vector<DenseCell> dense_cells(const GridLevel& fine, std::span<const DenseCell> of_fine,
                                   const HexMatrix& unit, const GridLevel& coarse);

}  // namespace palpate::physics
