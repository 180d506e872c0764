#pragma once
// Forces and impulses from outside on single nodes of a lattice body, after its elements have moved it.

#include "physics_node/step/lattice/state.h"
#include "physics_node/step/momentum_account.h"
#include "physics_node/step/node_motion.h"

namespace palpate::physics {

/// Adds a force that acts during the step of dt just integrated, to a node that nothing holds.
template <class Real>
void kick_node(const Body& body, LatticeState<Real>& state, const NodalForce& nodal, double dt,
               MomentumAccount& momentum) noexcept;

/// Adds a change of velocity at the beginning of that step. @param v_before  see NodeMotion::read(); EMPTY: nobody asks
template <class Real>
void push_node(const Body& body, LatticeState<Real>& state, const NodalPush& push, double dt,
               Three<Real>& v_before, MomentumAccount& momentum) noexcept;

}  // namespace palpate::physics
