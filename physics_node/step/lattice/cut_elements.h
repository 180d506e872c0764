#pragma once
// Springs that a blade has gone through.

#include <cstdint>
#include <span>

#include "physics_node/body/topology_events.h"
#include "physics_node/step/lattice/sleep.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// Between two steps. Both ends forget an element, state.fresh lists it behind what broke in the step before, and its row books
///
///   broken      f_s^2 / (2 k1), as of an element that breaks
///   dissipated  what its damper took in the step before, where the next would have booked that
///   plastic     what it yielded in the step before, likewise
///   numerical   the other half of the kick that does not come any more: see Energies::between
///
/// so that the books say the same before and after. No velocity changes, so neither do the momenta. Ends that sleep wake.
/// Contract: allocates and throws nothing.
/// @param elements  by their ends in any order; what does not live is passed over
/// @return how many were cut
template <class Real>
std::int64_t cut_elements(const Body& body, LatticeState<Real>& state, Sleep& sleep,
                          std::span<const EdgeGone> elements) noexcept;

}  // namespace palpate::physics
