#pragma once
// A step of backward_euler that is not over: bodies that touch are solved again, with the forces of their contact, before any moves on.

#include "physics_node/step/stepper.h"

namespace palpate::physics {

/// What acts on masses during a step.
struct StepForces {
  std::span<const NodalForce> tools;
  std::span<const NodalForce> contact;  // of bodies, and of the fragments of one, with each other
};

class PendingStep {
 public:
  virtual ~PendingStep() = default;
  /// Solves the step, or solves it again from the same beginning and the last solution, with other forces of contact. Until end() masses
  /// are where the step begins, and NodeMotion::read() tells the velocity that the solution moves them with.
  virtual void solve(const ExplicitStep& step, const StepForces& forces) noexcept = 0;
  /// The masses move on as it was solved last, with the same forces; what contact took is booked.
  virtual StepOutcome end(const ExplicitStep& step, const StepForces& forces) noexcept = 0;
};

}  // namespace palpate::physics
