#pragma once
// Steps a body in time, whatever the integrator, and brings it back where a step went wrong.

#include <cstdint>
#include <span>

#include "physics_node/step/explicit_step.h"
#include "physics_node/step/node_motion.h"

namespace palpate::physics {

struct StepOutcome {
  std::int64_t broken = 0;    // elements
  bool solved = true;         // false: backward_euler stopped before its tolerance
  double work = 0;            // of the forces, where the step solves for them: backward_euler [J]
  double contact_lost = 0;    // to ExplicitStep::planes [J]
  int newton_iterations = 0;  // of backward_euler
  int cg_iterations = 0;
  /// How much stiffer the stiffest part is than at rest, at most: the stable step is shorter by its root. Springs never are.
  double stiffening = 1;
  /// Least J = det F at a corner of a cell in all steps so far that were watched; not above 0: folded. Springs have none.
  double least_corner_J = 1;
};

/// What comes to a body from outside: forces of tools that press, or impulses of contact, floor and tools that lead, too.
enum class Disturbance { forces, impulses };

struct Bounces {
  std::int64_t masses = 0;
  double lost = 0;  // kinetic energy [J]
};

class Stepper {
 public:
  virtual ~Stepper() = default;

  /// A step: elements act, yield and break, forces act, masses move. An explicit integrator adds the forces when the elements have
  /// moved the masses (NodeMotion::kick); backward_euler solves for both.
  virtual StepOutcome advance(const ExplicitStep& step, std::span<const NodalForce> forces) noexcept = 0;
  /// Makes room for ExplicitStep::exact and, for impulses, remember_velocities(); while loading.
  virtual void prepare_for(Disturbance from_outside) = 0;
  /// Before a step in which something may touch: so that contact knows the velocities at its beginning. See NodeMotion::read().
  virtual void remember_velocities() noexcept = 0;
  /// Masses that were behind the plane when the step began, and approached it, are reflected: v_n := -e v_n. After an explicit step;
  /// backward_euler has the planes in its equations.
  /// @return how many, and the kinetic energy that the plane took
  virtual Bounces bounce_off(const Plane& plane, double e, double dt) noexcept = 0;

  /// Lets quiet rows sleep and disturbed ones wake, from what the last watched step saw.
  /// @param seconds  since the last call at the end of a frame; 0: in the midst of one, where rows wake but none
  ///                 falls asleep
  virtual void sleep_and_wake(double seconds) noexcept = 0;
  virtual void wake_all() noexcept = 0;
  virtual double sleeping_fraction() const noexcept = 0;  // of the masses

  virtual bool is_finite() const noexcept = 0;
  /// Remembers the state. Only the next call says whether it was good, since trouble shows later than it begins: `good`
  /// makes the state of the last call the one to go back to.
  virtual void save(bool good) noexcept = 0;
  virtual void restore() noexcept = 0;  // goes back to the last good state, at rest
  virtual void reset() noexcept = 0;    // as loaded
};

}  // namespace palpate::physics
