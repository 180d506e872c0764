#pragma once
// Tetrahedra of good shape that fill what a field says is inside: isosurface stuffing.
//
// A body-centred cubic lattice of cubes with edge a is laid over the place; its tetrahedra have two edges of a, which meet at the middles of
// cubes or at their corners, and four of sqrt(3)/2 a. Where the field crosses an edge nearer to an end than a share alpha of the edge, that end
// moves onto the crossing. What is left of each tetrahedron inside is one to three, from the table of tet_cut.h.
//
// Source: F. Labelle, J. R. Shewchuk 2007. Deviation: a face with four corners is cut along its shorter diagonal, not by parity, so their bound on the
// dihedral angles (10.7 degrees) is not proven for it; measured, they are larger (docs/volume_file.md).

#include <functional>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate {

struct StuffingLattice {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // what is outside this box is outside [m]
  double edge = 0.01;                            // a [m]
  Vec3 shift = Vec3::Zero();                     // of the lattice, in edges, 0 to 1
};

/// Points of the lattice: what its arrays are as long as.
double points_of(const StuffingLattice& lattice) noexcept;

/// @param inside  of a place: above 0 inside, below outside; continuous. Asked often, in order
/// @return turned, nodes in use only; empty where nothing is inside. The same bits every time
physics::TetMesh stuff(const StuffingLattice& lattice, const std::function<double(const Vec3&)>& inside);

}  // namespace palpate
