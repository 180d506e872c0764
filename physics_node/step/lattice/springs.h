#pragma once
// The papers' elements: springs with dampers that yield and break.

#include "physics_node/step/lattice/element_step.h"
#include "physics_node/step/lattice/lattice_elements.h"
#include "physics_node/step/lattice/measure.h"

namespace palpate::physics {

template <class Real>
class Springs final : public LatticeElements<Real> {
 public:
  StepOutcome step(const Body& body, LatticeState<Real>& state, const ExplicitStep& step) noexcept override {
    return {.broken = element_step(body, state, step)};
  }
  Energies energies(const Body& body, const LatticeState<Real>& state, const Vec3& gravity) const override {
    return measure_energies(body, state, gravity);
  }
  double energy_now(const Body& body, const LatticeState<Real>& state) const noexcept override {
    const Energies now = measure_energies(body, state, Vec3::Zero());
    return now.kinetic + now.elastic;
  }
  Losses due(const Body& body, const LatticeState<Real>& state) const override {
    return measure_due(body, state);
  }
  BodyCounts counts(const Body& body, const LatticeState<Real>& state) const override {
    return measure_counts(body, state);
  }
};

}  // namespace palpate::physics
