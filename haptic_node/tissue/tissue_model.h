#pragma once
// Tissue under a tip, along the normal of the contact, reduced to what a hand can feel of it:
//
//   q_i'' + c_i q_i' + omega_i^2 q_i = phi_i (F - F_r),     y = r + sum phi_i q_i,     z = y + s F
//   F_r = sum k_j (y - p_j),   p_j' = (y - p_j) / tau_j
//
// F presses the tissue, z is its surface; depths count into the tissue. Modes (phi > 0, normalised by mass), the compliance s
// of all that follows at once, branches that relax, and the rest r that they lie on. No modes, no compliance: a wall at r.

#include <array>
#include <cstdint>

#include "common/message/limits.h"

namespace palpate::haptic {

struct TissueMode {
  double phi = 0;        // of the surface under the tip, > 0 [1 / sqrt(kg)]
  double stiffness = 0;  // omega^2 [1/s^2]
  double damping = 0;    // c [1/s]
};

struct RelaxingBranch {
  double stiffness = 0;  // k [N/m]
  double time = 1;       // tau, > 0 [s]
};

struct TissueModel {
  static constexpr std::size_t most_modes = max_tissue_modes, most_branches = max_tissue_branches;
  std::uint32_t n_modes = 0, n_branches = 0;
  std::array<TissueMode, most_modes> modes{};
  std::array<RelaxingBranch, most_branches> branches{};
  double residual = 0;  // s [m/N]

  bool same_counts(const TissueModel& other) const noexcept {
    return n_modes == other.n_modes && n_branches == other.n_branches;
  }
};

struct TissueState {
  std::array<double, TissueModel::most_modes> q{}, w{};  // [m sqrt(kg)], and per second
  std::array<double, TissueModel::most_branches> p{};    // where relaxing branches lie [m]
  double rest = 0;                                       // r [m]
  double force = 0;                                      // F, not below 0 [N]
};

/// y: the surface less what the residual compliance gives [m].
inline double modal_surface(const TissueModel& model, const TissueState& state) noexcept {
  double y = state.rest;
  for (std::uint32_t i = 0; i < model.n_modes; ++i) y += model.modes[i].phi * state.q[i];
  return y;
}

/// y' [m/s]
inline double modal_speed(const TissueModel& model, const TissueState& state) noexcept {
  double speed = 0;
  for (std::uint32_t i = 0; i < model.n_modes; ++i) speed += model.modes[i].phi * state.w[i];
  return speed;
}

/// F_r at y [N]
inline double relaxing_force(const TissueModel& model, const TissueState& state, double y) noexcept {
  double force = 0;
  for (std::uint32_t j = 0; j < model.n_branches; ++j)
    force += model.branches[j].stiffness * (y - state.p[j]);
  return force;
}

/// In modes and branches: sum (w^2 + omega^2 q^2) / 2 + sum k (y - p)^2 / 2 [J]. That of the compliance belongs to the spring.
inline double tissue_energy(const TissueModel& model, const TissueState& state) noexcept {
  double twice = 0;
  for (std::uint32_t i = 0; i < model.n_modes; ++i)
    twice += state.w[i] * state.w[i] + model.modes[i].stiffness * state.q[i] * state.q[i];
  const double y = model.n_branches > 0 ? modal_surface(model, state) : 0.0;
  for (std::uint32_t j = 0; j < model.n_branches; ++j)
    twice += model.branches[j].stiffness * (y - state.p[j]) * (y - state.p[j]);
  return 0.5 * twice;
}

/// What physics tells of one contact: the model, and the state that the hand's sample number `stamp` brought it to.
struct TissueAnswer {
  std::uint64_t tick = 0;   // of the frame
  std::uint32_t tool = 0;   // whose contact it is
  std::uint64_t stamp = 0;  // of the last sample of the hand that has been played
  TissueModel model;
  TissueState state;
};

/// All numbers finite and in bounds, phi and tau above 0, nothing else below 0. Otherwise it is rejected whole.
bool is_sound(const TissueAnswer& answer, std::uint32_t tool) noexcept;

}  // namespace palpate::haptic
