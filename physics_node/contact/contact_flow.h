#pragma once
// How what a tool presses flows. Of a force F on tissue each part of which relaxes alike, F_e is what stays,
//
//   F = F_e + sum g_j (F_e - f_j),   f_j' = (F_e - f_j) / tau_j
//
// and the tissue lies as it would under F_e for ever (Lee & Radok 1960: of a contact that grows; so its inertia is not
// in it). With E of a sudden strain, of which shares s_j fade and which has a viscosity beta E,
//
//   E_inf = (1 - sum s_j) E,   g_j = s_j E / E_inf,   and beta E F_e' / E_inf as one branch more, whose tau is short
//
// Source: Lee & Radok 1960; Johnson, Contact Mechanics, 6.5. The short branch is ours.

#include <array>
#include <span>

#include "common/math/lag_step.h"
#include "common/message/limits.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

class ContactFlow {
 public:
  struct Branch {
    double share = 0, time = 1;  // g, tau [s]
    double force = 0;            // f [N]
    bool viscous = false;        // the body's dampers
  };
  /// Of a body that nothing has pressed. Springs flow by their dampers, but for drag; what is not damped and does not
  /// relax not at all.
  void begin(const Body& body) noexcept;
  /// Where nothing has been pressed.
  void rest() noexcept;
  /// F goes straight to a new value within dt. Cost: nothing of what does not flow; contract: takes no memory.
  void pass(double F, double dt) noexcept;

  double staying() const noexcept { return staying_; }  // F_e [N]
  double lasting() const noexcept { return lasting_; }  // E_inf / E
  std::span<const Branch> branches() const noexcept { return {branches_.data(), n_}; }

 private:
  void add(double share, double time, bool viscous) noexcept;
  void set_step(double dt) noexcept;

  std::array<Branch, max_tissue_branches> branches_{};
  std::array<LagStep, max_tissue_branches> steps_{};  // of f behind F_e
  std::size_t n_ = 0;
  double dt_ = 0;         // that steps_ are for [s]
  double stiffness_ = 1;  // 1 + sum g mean
  double lasting_ = 1, staying_ = 0;
};

}  // namespace palpate::physics
