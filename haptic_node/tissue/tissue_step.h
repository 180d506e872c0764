#pragma once
// Tissue pressed through a spring over one tick. The force grows linearly over it, modes answer exactly, and its value at the
// end is solved for, so that stiff springs on light tissue need no substeps. At the end of the tick
//
//   y+ = alpha + sigma F+,    y+' = v0 + nu F+         from the modes, and from branches exact for a y that is linear
//   F+ = min over { F without bounds, F at 3/2 of the spring }, at least 0
//
// Each law alone falls with F+, and so does the least of them: the least of their solutions solves it, without iterations.

#include <array>

#include "haptic_node/tissue/contact_spring.h"
#include "haptic_node/tissue/mode_response.h"

namespace palpate::haptic {

/// Where energy went in a step.
struct StepWork {
  double given = 0;  // by the hand's point to spring and tissue: the mean force times the way [J]
  double dissipated =
      0;  // of it, what neither stores; below 0 by what the clamps and the damper's difference leave [J]
};

class TissueStep {
 public:
  TissueStep() = default;
  TissueStep(const TissueModel& model, const ContactSpring& spring, double h) noexcept;

  /// One tick.
  /// @param x_before, x  the hand at its beginning and end [m]
  /// @param v            of the hand at its end, smoothed [m/s]
  void advance(TissueState& state, double x, double v) const noexcept;
  StepWork advance(TissueState& state, double x_before, double x, double v) const noexcept;

  /// In spring, compliance, modes and branches, H [J].
  double energy(const TissueState& state, double x) const noexcept;
  /// In spring and compliance [J].
  double spring_energy(const TissueState& state, double x) const noexcept;
  /// F that the law of the spring gives at x, v for the state as it is [N].
  double force_at(const TissueState& state, double x, double v) const noexcept;

  const TissueModel& model() const noexcept { return model_; }
  const ContactSpring& spring() const noexcept { return spring_; }
  double h() const noexcept { return h_; }

 private:
  struct Branch {
    double keep = 1, first = 0, last = 0;  // p+ = keep p + first y + last y+
  };
  TissueModel model_;
  ContactSpring spring_;
  double h_ = 1e-3;
  std::array<ModeResponse, TissueModel::most_modes> modes_{};
  std::array<Branch, TissueModel::most_branches> branches_{};
  double relaxing_ = 0;  // sum k (1 - last): F_r+ by y+ [N/m]
  double sigma_ = 0;     // y+ by F+ [m/N]
  double nu_ = 0;        // y+' by F+ [m/(N s)]
};

}  // namespace palpate::haptic
