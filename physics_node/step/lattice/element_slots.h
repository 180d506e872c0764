#pragma once
// The constants of a body's elements as the kernel reads them.

#include <array>

#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// By row kind: the elements of which a mass is the first end in storage; all of them, those within the plane of z, and
/// those to the next plane.
template <class Real>
void make_slots(const Body& body, std::array<SlotList<Real>, max_row_kinds>& all,
                std::array<SlotList<Real>, max_row_kinds>& level,
                std::array<SlotList<Real>, max_row_kinds>& up);

/// For a body of several materials.
template <class Real>
VariedConstants<Real> make_varied_constants(const Body& body, std::size_t first_colour);

}  // namespace palpate::physics
