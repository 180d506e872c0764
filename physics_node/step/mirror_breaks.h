#pragma once
// Both ends of an element know whether it lives.

#include "physics_node/step/state.h"

namespace palpate::physics {

/// The kernel takes a broken element out of the mask of its first end; this takes it out of the other's. A pass over
/// all masses if anything broke since the last call, over the rows' counters otherwise.
/// @return elements broken since the last call
template <class Real>
std::int64_t mirror_breaks(const Body& body, LatticeState<Real>& state) noexcept;

}  // namespace palpate::physics
