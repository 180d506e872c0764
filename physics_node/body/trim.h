#pragma once
// What is taken from the masses of an fcc lattice before elements join them. All of these work on mass_share alone.

#include <functional>

#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

/// Keeps the masses that are fewer than `layers` steps between neighbours from `outside(grid)`.
/// @return whether anything was further in
bool keep_outer_layers(Lattice& lattice, int layers, const std::function<bool(const Vec3i&)>& outside);

/// Takes away masses with fewer than `fewest` neighbours until there are none: a mass that hangs on two elements swings.
void drop_loose_masses(Lattice& lattice, int fewest);

/// Keeps the largest of the parts that neighbours make, the first in storage where several are as large.
void keep_largest_part(Lattice& lattice);

}  // namespace palpate::physics
