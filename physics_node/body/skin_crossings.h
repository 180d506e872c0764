#pragma once
// Where the tissue of a body of cells ends: skin = "smooth".
//
//   phi = min(I - lo, hi - I)                    of an image that is kept from lo to hi
//   s   = phi_in / (phi_in + |phi_out|)          from the centre of the filled cell to that of the empty one
//
// Where both are kept, the empty one went for another reason (a piece of its own, another wall), and s is as for what
// mirrors it. Of a shape, and where a cavity was taken away, s is where its wall lies. Beyond the image it ends at
// the face of the cell.

#include "common/scene/scene_fwd.h"
#include "physics_node/body/cells.h"

namespace palpate::physics {

/// Why: vertices that fall on the centres of cells would meet there.
inline constexpr double least_crossing = 0.01;

/// Fills `crossings` of cells whose `filled`, and `intensity` of an image, are known.
/// Cost: a look at every face of a cell; 30 at the shape where a wall lies.
void find_crossings(const BodySpec& body, Cells& cells);

}  // namespace palpate::physics
