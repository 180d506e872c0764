#pragma once
// Floor and walls.

#include "physics_node/step/lattice/state.h"
#include "physics_node/step/momentum_account.h"
#include "physics_node/step/stepper.h"

namespace palpate::physics {

/// After an explicit step: masses that were behind the plane when the step of dt began, and moved further behind it, are reflected
/// there: by rebound(), with v as NodeMotion::read() has it, and the step goes on from there. Skips rows that sleep.
/// @param moving  velocity that moved the masses in the step
/// @param before  in the one before, which takes part in the bounce as the mean of both is v
/// Source: Wakamatsu & Honma 2011 (bodies that fall on a floor).
template <class Real>
Bounces bounce(const Body& body, LatticeState<Real>& state, const Three<Real>& moving, Three<Real>& before,
               const Plane& plane, double e, double dt, MomentumAccount& momentum) noexcept;

}  // namespace palpate::physics
