#pragma once
// What holds the masses of a lattice body together. One call is a whole body's.

#include "physics_node/body/body.h"
#include "physics_node/step/books.h"
#include "physics_node/step/explicit_step.h"
#include "physics_node/step/lattice/state.h"
#include "physics_node/step/stepper.h"

namespace palpate::physics {

template <class Real>
class LatticeElements {
 public:
  virtual ~LatticeElements() = default;

  /// One explicit step of all masses that are awake. Contract: allocates, locks and throws nothing.
  virtual StepOutcome step(const Body& body, LatticeState<Real>& state,
                           const ExplicitStep& step) noexcept = 0;
  virtual Energies energies(const Body& body, const LatticeState<Real>& state, const Vec3& gravity) const = 0;
  /// Books::energy_now().
  virtual double energy_now(const Body& body, const LatticeState<Real>& state) const noexcept = 0;
  /// What the next step books at once: Books::due().
  virtual Losses due(const Body& body, const LatticeState<Real>& state) const = 0;
  /// All of BodyCounts but the shape.
  virtual BodyCounts counts(const Body& body, const LatticeState<Real>& state) const = 0;
};

}  // namespace palpate::physics
