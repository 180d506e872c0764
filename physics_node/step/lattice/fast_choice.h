#pragma once
// Whether few stiff cells of a body take steps of their own, and which.

#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

/// The stable step of a body [s], as stable_step() has it. Where that saves at least a third of the work, its stiffest cells are
/// told to take steps of their own (SolidElements::fast), and it is that of the rest.
///
///   work = steps of the rest x (cells + substeps x fast cells x what one costs),   against   steps x cells
///
/// Not where cells yield, break or relax, nor with another integrator, `step_ms` or `subcycle = false`; nor where something may touch
/// stiff cells: what a touch moves its nodes by is a matter of the whole step, in which these do not stay as they were moved.
/// The rest takes steps of at most ten times viscosity over modulus, so that without viscosity it does not pay: see least_lag.
/// @param touched  may anything touch bodies?
/// @param remarks  gets a line where it does, and where it would but for what may touch
double settle_step(const BodySpec& spec, Body& body, const Scene& scene, bool touched,
                   std::vector<std::string>& remarks);

}  // namespace palpate::physics
