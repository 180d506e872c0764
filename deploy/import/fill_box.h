#pragma once
// Stuffing of a box with the lattice moved until the surface nowhere touches itself.

#include <functional>
#include <string>

#include "deploy/import/stuffing.h"
#include "physics_node/mesh/mesh_pinches.h"

namespace palpate {

/// @throws InputError: more points than any machine could step
void check_points(const StuffingLattice& lattice, const std::string& where);

/// @throws InputError: nothing is filled, or it misses what was to be filled by more than a tenth  @param what  it is: "this tissue", "this surface"
void check_filled(double filled, double wanted, double edge, const std::string& what,
                  const std::string& where);

struct FilledBox {
  physics::TetMesh mesh;
  physics::Pinches pinches;  // of the last place of the lattice; none where one was found
};

/// @param lattice  tried as it lies, then shifted, the same way every time
/// @param stuff  makes a mesh  @param settle  makes a better one of it, which may touch itself again
FilledBox fill_box(StuffingLattice lattice,
                   const std::function<physics::TetMesh(const StuffingLattice&)>& stuff,
                   const std::function<physics::TetMesh(const StuffingLattice&, physics::TetMesh)>& settle);

}  // namespace palpate
