#pragma once
// What the hexahedra around a mass have been through: yielded, begun to break, gone.

#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// How many of the cells that live around a mass have yielded or lost stiffness, [0, 1]; of a mass without any, 1.
template <class Real>
double marked_share(const Body& body, const LatticeState<Real>& state, Index node) noexcept;
/// Has any of them, gone ones too?
template <class Real>
bool is_marked(const Body& body, const LatticeState<Real>& state, Index node) noexcept;

}  // namespace palpate::physics
