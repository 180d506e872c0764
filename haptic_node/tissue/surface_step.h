#pragma once
// A surface pressed over one tick by a tip that hangs on spring and damper, with friction. The force grows linearly over the
// tick and modes answer exactly; with q_f, w_f where they would be without a force at its end, F+ there solves
//
//   C F+ = e,    C = I / K + R + sum c1 psi psi^T + B / K n n^T (R / h + sum d1 psi psi^T)
//                e = x - (X + r + sum psi q_f) + B / K n n^T (v - sum psi w_f + R F / h)
//
// within the cone of friction: solve_contact(). The damper acts along the normal alone, through the residual compliance; the
// force is at least 0 and at most 3/2 of what the spring gives, as contact_spring.h has it in one dimension.
// What slides moves xi, by half of it, twice in a tick: a whole step hops to and fro between nodes where nothing rubs.

#include "haptic_node/tissue/contact_spring.h"
#include "haptic_node/tissue/mode_response.h"
#include "haptic_node/tissue/motion_history.h"
#include "haptic_node/tissue/tissue_step.h"
#include "haptic_node/tissue/tissue_surface.h"

namespace palpate::haptic {

class SurfaceStep {
 public:
  static constexpr int moves = 2;
  static constexpr double share_moved = 0.5;

  /// @param modes  of the model that is stepped; h [s]
  SurfaceStep(const SurfaceModel& model, const ContactSpring& spring, double h) noexcept;

  /// One tick. @param tip  at its end
  void advance(const SurfaceModel& model, SurfaceState& state, const TipSample& tip) const noexcept;
  /// @param before  the tip at its beginning [m]
  StepWork advance(const SurfaceModel& model, SurfaceState& state, const Vec3& before,
                   const TipSample& tip) const noexcept;

  const ContactSpring& spring() const noexcept { return spring_; }
  double h() const noexcept { return h_; }

 private:
  ContactSpring spring_;
  double h_;
  std::array<ModeResponse, SurfaceModel::most_modes> modes_{};
};

/// A state as it is, held by the spring alone.
struct HeldSurface {
  SurfacePoint point;
  FrictionContact contact;
  double spring_energy = 0;  // in spring and residual compliance [J]
  double energy = 0;         // and in modes, H [J]
};
HeldSurface held_surface(const SurfaceModel& model, const SurfaceState& state, const ContactSpring& spring,
                         const Vec3& x) noexcept;

}  // namespace palpate::haptic
