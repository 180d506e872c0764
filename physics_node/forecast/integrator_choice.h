#pragma once
// integrator = "auto": explicit steps, or whole frames that are solved. Chosen once, when the bodies are loaded.

#include <string>

#include "common/scene/kinds.h"
#include "common/scene/scene_fwd.h"

namespace palpate::physics {

struct IntegratorChoice {
  Integrator integrator = Integrator::symplectic_euler;
  std::string remark;  // why, for a person; empty where explicit steps are few and nothing needs saying
};

/// backward_euler from so many explicit steps in a frame on. Why: `palpate bench fem`, frames of a pressed cube at equal CPU time:
/// 59 steps at 10 kPa, 43 at 100 kPa, 42 at 1 MPa, 52 with a lump of 1 MPa in 10 kPa; on the dear side of all of them.
inline constexpr double worth_solving_cells = 60;
/// The same of springs, which are solved on one thread. Why: 92 steps took 0.29 s where solving took 0.32 s (docs/benchmarks.md).
inline constexpr double worth_solving_springs = 100;

/// backward_euler where that is cheaper and follows all that the scene has; else symplectic_euler, and the remark says what of the scene
/// is in the way. A scene that yields or breaks stays explicit, springs too: their limits are then met in every step.
/// @param explicit_dt  stable step of symplectic_euler; infinite: nothing moves [s]
IntegratorChoice choose_integrator(const Scene& scene, double explicit_dt);

}  // namespace palpate::physics
