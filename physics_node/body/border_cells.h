#pragma once
// How much of each cell at the border of a shape is tissue: border_cells = "filled".
//
// A cell is seen, drawn and touched, where its centre lies in the shape, as ever. A finite element is as stiff and as heavy as
// the share of it that the shape fills, and so are those of cells that are not seen although the shape reaches into them.
// What bends is then the shape and not its stairs (the finite cell method of lowest order: Parvizian, Duester & Rank 2007).

#include "common/scene/scene_fwd.h"
#include "physics_node/body/cells.h"

namespace palpate::physics {

/// Why: less would be a cell that nothing but rounding moves.
inline constexpr float least_share = 1.0F / 32;

/// Of an image at a place of the world, linear along each axis between the centres of cells; beyond the outermost it
/// stays.
double intensity_between(const Cells& cells, const Vec3& p);

/// Fills `share` of cells whose `filled` and `deformable` are known. Of an image, the shape is where the intensity between the centres
/// of cells, linear along each axis, lies in the window that is kept; where its edge cuts tissue off, cells are whole. Seen
/// cells have at least least_share, others that or nothing: what lies in less belongs to the cells beside it, so that nothing is lost.
/// Cost: 4096 looks at the shape (64 at the image) a cell at the border, 125 a cell inside.
void fill_border_cells(const BodySpec& body, Cells& cells);

}  // namespace palpate::physics
