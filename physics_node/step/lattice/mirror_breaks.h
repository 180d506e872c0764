#pragma once
// Both ends of an element know whether it lives.

#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// The kernel takes a broken element out of the mask of its first end in storage; this takes it out of the other's and
/// lists it in state.fresh, in storage order. Looks at the counters of all rows, and at the masses of those rows only in
/// which something broke since the last call. Contract: allocates and throws nothing.
/// @return elements broken since the last call
template <class Real>
std::int64_t mirror_breaks(const Body& body, LatticeState<Real>& state) noexcept;

}  // namespace palpate::physics
