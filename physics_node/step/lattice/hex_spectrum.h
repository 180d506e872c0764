#pragma once
// The fastest vibration of a body of hexahedra near rest.

#include <cstdint>
#include <span>

#include "physics_node/step/lattice/stable_step.h"

namespace palpate::physics {

/// Largest squared frequency and damping rate near rest, of the body as it is: its shape, its materials, what is held.
///
///   w^2 = largest eigenvalue of M^-1/2 K M^-1/2,   by Lanczos, K applied by the kernel itself
///
/// plus what the iteration may still miss by its own residual; never more than the bound that needs no iteration: no body
/// vibrates faster than its fastest cell alone would, w^2 <= largest eigenvalue of a cell / (density V / 8). On a cube of uniform
/// cells that bound allows 0.7 of the step that is stable.
/// Of cells that may be cut that bound is what counts: a cut may leave each of them alone.
/// Cost: at most 60 sweeps over the cells, in double; of more than a million nodes in float and some ten, and w^2 is up to 2 % too large.
StiffestMode stiffest_mode_of_hexahedra(const Body& body);

/// The same where only some cells have a stiffness, without the bound of a single cell; all nodes keep their masses.
/// @param counts  1: cells of this lowest corner do  (n_cells)
StiffestMode stiffest_mode_of_hexahedra(const Body& body, std::span<const std::uint8_t> counts);

}  // namespace palpate::physics
