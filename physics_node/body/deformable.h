#pragma once
// Which of the kept cells of an image deform; the rest is rigid scenery.

#include "common/scene/shape_spec.h"
#include "physics_node/body/cells.h"

namespace palpate::physics {

/// The cell whose centre is nearest to the centre of gravity of the filled ones; at least one is.
Vec3i gravity_cell(const Cells& cells);

/// Sets `deformable` from `filled`: all of them; those within a Chebyshev radius of the centre; or so many, the
/// nearest to it in the world, in storage order where several are as near (EQUATIONS C-39: "10 voxels around the
/// gravity centre", the radius by default and the literal ten on request). A centre may lie outside the image.
/// Cost: all cells once for the centre of gravity, else only the neighbourhood beyond clearing the array.
void mark_deformable(Cells& cells, const DeformableRegion& region);

}  // namespace palpate::physics
