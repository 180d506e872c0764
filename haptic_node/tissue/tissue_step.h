#pragma once
// Tissue pressed over one tick by a tip that hangs on spring and damper, with friction. The force grows linearly over the tick, modes answer
// exactly, and its value at the end is solved for, so that stiff springs on light tissue need no substeps. With y_f, y_f' where the modal
// surface would be without a force at the end (branches exact for a depth that is linear),
//
//   y+ = y_f + D F+,   y+' = y_f' + E F+,   D = sum c1 psi psi^T less what branches hold of it, E alike with d1
//   C F+ = e,   C = I / K + R + D + B / K n n^T (R / h + E),   e = x - y_f + B / K n n^T (v - y_f' + R F / h)
//
// within the cone of friction: solve_contact(). C is the same in all ticks: the whole tick is a few dozen products a mode. The damper acts along
// the normal alone, through the residual compliance; the force is at least 0 and at most 3/2 of what the spring gives, as contact_spring.h has
// it. What slides moves the rest.
// Where the contact grows with the force, R F along n is z(F_n), and so in the bound: Newton's steps, each of a contact that gives alike,
// R -> dz/dF, e -> e + (z - F_n dz/dF) n; z grows ever more slowly, so that they go up to F_n from below. Two in most ticks.
// Where it flows, z is of F_e, which is linear in the tick as well: F_e+ = (F+ + lag) / (1 + sum g mean_j), so that
// a tick is as with a contact that gives less, from another place.

#include <array>

#include "common/math/lag_step.h"
#include "haptic_node/tissue/contact_spring.h"
#include "haptic_node/tissue/mode_response.h"
#include "haptic_node/tissue/motion_history.h"
#include "haptic_node/tissue/tissue_model.h"

namespace palpate::haptic {

/// Where energy went in a step.
struct StepWork {
  double given = 0;  // by the hand's point to spring and tissue: the mean force times the way [J]
  double dissipated =
      0;  // of it, what neither stores; below 0 by what the clamps and the damper's difference leave [J]
};

/// z of F, where F_e = share (F + lag) is what it follows.
struct FlowingContact {
  GrowingContact law;
  double share = 1, lag = 0;

  double staying(double F) const noexcept { return share * (F + lag); }  // F_e
  double give(double F) const noexcept { return law.give(staying(F)); }  // z [m]
  GrowingContact::Tangent tangent(double F) const noexcept {             // of z over F
    const GrowingContact::Tangent z = law.tangent(staying(F));
    return {share * z.slope, z.offset + share * z.slope * lag};
  }
  /// Is the root right to `precision` that the tangent at F has at `next`? What it leaves is z'' / (2 z') times the
  /// square of the step.
  bool is_enough(double F, double next, double precision) const noexcept {
    return share * law.growth / (6 * (1 + law.growth * staying(F))) * (next - F) * (next - F) <= precision;
  }
};

/// A state as it is, held by the spring alone.
struct HeldTissue {
  FrictionContact contact;
  double spring_energy = 0;  // in spring and residual compliance, with what flows in that [J]
  double energy = 0;         // and in modes and branches, H [J]
};
HeldTissue held_tissue(const TissueModel& model, const TissueState& state, const ContactSpring& spring,
                       const Vec3& x) noexcept;

class TissueStep {
 public:
  TissueStep() = default;
  TissueStep(const TissueModel& model, const ContactSpring& spring, double h) noexcept;

  /// One tick. @param tip  at its end
  void advance(TissueState& state, const TipSample& tip) const noexcept;
  /// @param before  the tip at its beginning [m]
  StepWork advance(TissueState& state, const Vec3& before, const TipSample& tip) const noexcept;

  HeldTissue held(const TissueState& state, const Vec3& x) const noexcept {
    return held_tissue(model_, state, spring_, x);
  }
  /// dF/dt along the normal over the next tick, if the tip goes on at this speed into the modal surface [N/s]
  double rising(const TissueState& state, double speed) const noexcept;
  const TissueModel& model() const noexcept { return model_; }
  const ContactSpring& spring() const noexcept { return spring_; }
  double h() const noexcept { return h_; }

 private:
  /// Where nothing presses at the end of a tick.
  struct Loose {
    Vec3 stretch = Vec3::Zero();  // from the modal surface to the tip [m]
    double late =
        0;  // how fast that grows along n, were the residual back where nothing presses at the end [m/s]
  };
  FrictionContact press(const Loose& loose, const FlowingContact& law) const noexcept;
  FrictionContact press_growing(const Loose& loose, const FlowingContact& law, double before) const noexcept;

  TissueModel model_;
  ContactSpring spring_;
  double h_ = 1e-3;
  std::array<ModeResponse, TissueModel::most_modes> modes_{};
  std::array<LagStep, TissueModel::most_branches> branches_{};  // of p behind d, and of f behind F_e
  double relaxing_ = 0, held_ = 0;                    // sum k mean: F_r+ by d+ [N/m]; 1 / (1 + relaxing n.Dn)
  double flowing_ = 1;                                // 1 / (1 + sum g mean): F_e+ by F+
  Vec3 pushed_ = Vec3::Zero(), sped_ = Vec3::Zero();  // D n, E n, branches apart [m/N], [m/(N s)]
  Mat3 compliance_ = Mat3::Zero(), inverse_ = Mat3::Zero();  // C
  Mat3 bound_ = Mat3::Zero();                                // (I / K + R) / (3/2) + D
};

}  // namespace palpate::haptic
