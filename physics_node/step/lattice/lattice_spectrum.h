#pragma once
// The stiffest vibration that a lattice can have.

#include <array>

#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

/// Largest eigenvalue of the stiffness matrix of the endless lattice at rest whose elements have spring constants k [N/m].
/// Plane waves (Bloch): a mass carries the phase q . X, and
///
///   D(q) = sum over elements of k n n^T (self) - k n n^T cos(q . delta) (other end)
///
/// is 3 x 3 on the face-centred lattice and 6 x 6 on voxels, whose even and odd masses differ; its largest eigenvalue
/// over q in [0, pi]^3 is taken on a grid that contains the corners of the zone. No body cut out of this lattice, held
/// anywhere, has a larger one: taking elements or masses away only lowers eigenvalues. With the damping constants for k
/// it bounds the dampers' matrix in the same way.
/// Cost: a few thousand small eigenvalue problems, some milliseconds.
double largest_eigenvalue(const Lattice& lattice, const std::array<double, max_half>& k);

}  // namespace palpate::physics
