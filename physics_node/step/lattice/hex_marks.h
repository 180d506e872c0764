#pragma once
// What the hexahedra around a mass have been through: yielded, begun to break, gone. And what a mass has, of springs too.

#include "physics_node/step/lattice/state.h"
#include "physics_node/step/topology.h"

namespace palpate::physics {

/// How many of the cells that live around a mass have yielded or lost stiffness, [0, 1]; of a mass without any, 1.
template <class Real>
double marked_share(const Body& body, const LatticeState<Real>& state, Index node) noexcept;
/// Has any of them, gone ones too?
template <class Real>
bool is_marked(const Body& body, const LatticeState<Real>& state, Index node) noexcept;

/// Of a mass. Where cells are cut nothing else happens to them, and that is no trouble of theirs.
template <class Real>
Condition condition_of(const Body& body, const LatticeState<Real>& state, const Adjacency& now,
                       Index node) noexcept;

}  // namespace palpate::physics
