#pragma once
// The fastest vibration of a closed surface of springs near rest.

#include <vector>

#include "physics_node/body/spring_surface.h"
#include "physics_node/step/lattice/stable_step.h"

namespace palpate::physics {

/// Largest squared frequency and damping rate near rest: the smaller of the bounds of SurfaceSprings and what Lanczos
/// finds. Of triangles that differ in size a bound by node takes the neighbours of the smallest for as light: of a
/// surface cut from an image it is 1.6 times too large.
/// Cost: at most 60 sweeps over springs and triangles, in double; twice that where it is filled and damped.
/// @param inverse_mass  of each node, 0: held, and maybe of copies, which are left out [1/kg]
StiffestMode stiffest_mode_of_surface(const SpringSurface& surface, std::vector<double> inverse_mass);

/// However it is cut: of its triangles each for itself, which no assembly of them exceeds. Without what it is filled with.
/// Source: Irons & Treharne 1971. Cost: an eigenvalue problem of 9 x 9 for each triangle.
StiffestMode stiffest_mode_of_loose_triangles(const SpringSurface& surface);

}  // namespace palpate::physics
