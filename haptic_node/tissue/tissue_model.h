#pragma once
// Tissue under a tip, reduced to what a hand can feel of it. A force F on it, at the point where the tip touches:
//
//   q_i'' + c_i q_i' + omega_i^2 q_i = psi_i . (F + F_r n),     y = r + sum psi_i q_i,     S = y + R F
//   F_r = sum k_j (d - p_j),   p_j' = (d - p_j) / tau_j,   d = -n . (y - r)
//
// R F along n: z(F_e) of a contact that grows (common/math/growing_contact.h). What flows under the tip as well bears F
// by more than that,
//
//   F = F_e + sum g_j (F_e - f_j),   f_j' = (F_e - f_j) / tau_j
//
// as tissue does of which each part relaxes alike, since the patch it is pressed on follows from z (Lee & Radok 1960,
// while it grows). A viscous one, F = F_e + beta F_e', is a branch of g = beta / tau with a short tau. A cycle gives
// nothing, since z grows with F_e.
//
// S is where the surface is, n its normal, out of the tissue; the tip rubs there with Coulomb's friction mu. Modes (normalised by mass), the
// compliance R of all that is not of them, along n and across it, branches that relax along n, and the rest r that they lie on. What slides
// moves r along the surface. No modes, no compliance: a wall at r.

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/math/growing_contact.h"
#include "common/math/vec3.h"
#include "common/message/limits.h"
#include "haptic_node/tissue/friction_contact.h"

namespace palpate::haptic {

struct TissueMode {
  Vec3 psi = Vec3::Zero();  // of the surface under the tip [1 / sqrt(kg)]
  double stiffness = 0;     // omega^2 [1/s^2]
  double damping = 0;       // c [1/s]
};

struct RelaxingBranch {
  double stiffness = 0;  // k [N/m]
  double time = 1;       // tau, > 0 [s]
  double share = 0;      // g
};

struct TissueModel {
  static constexpr std::size_t most_modes = max_tissue_modes, most_branches = max_tissue_branches;
  Vec3 normal = Vec3::UnitZ();  // n
  double friction = 0;          // mu
  std::uint32_t n_modes = 0, n_branches = 0;
  std::array<TissueMode, most_modes> modes{};
  std::array<RelaxingBranch, most_branches> branches{};
  double residual = 0, residual_across = 0;  // R along n at the first touch, and across it [m/N]
  double growth = 0;                         // of the contact [1/N]

  bool same_counts(const TissueModel& other) const noexcept {
    return n_modes == other.n_modes && n_branches == other.n_branches;
  }
  GrowingContact contact() const noexcept { return {residual, growth}; }  // z
  /// 1 + sum g: F over F_e where it changes at once.
  double stiffening() const noexcept {
    double all = 1;
    for (std::uint32_t j = 0; j < n_branches; ++j) all += branches[j].share;
    return all;
  }
  /// R at the first touch. @param share  of R along n
  Mat3 compliance(double share = 1) const noexcept {
    return residual_across * Mat3::Identity() +
           (share * residual - residual_across) * normal * normal.transpose();
  }
};

struct TissueState {
  std::array<double, TissueModel::most_modes> q{}, w{};  // [m sqrt(kg)], and per second
  std::array<double, TissueModel::most_branches> p{};    // where relaxing branches lie, below r [m]
  std::array<double, TissueModel::most_branches> f{};    // what those of the contact have come to [N]
  Vec3 rest = Vec3::Zero();                              // r [m]
  Vec3 force = Vec3::Zero();                             // F [N]
};

/// sum psi q [m]
inline Vec3 modal_way(const TissueModel& model, const TissueState& state) noexcept {
  Vec3 way = Vec3::Zero();
  for (std::uint32_t i = 0; i < model.n_modes; ++i) way += state.q[i] * model.modes[i].psi;
  return way;
}

/// y [m]
inline Vec3 modal_surface(const TissueModel& model, const TissueState& state) noexcept {
  return state.rest + modal_way(model, state);
}

/// y' [m/s]
inline Vec3 modal_speed(const TissueModel& model, const TissueState& state) noexcept {
  Vec3 speed = Vec3::Zero();
  for (std::uint32_t i = 0; i < model.n_modes; ++i) speed += state.w[i] * model.modes[i].psi;
  return speed;
}

/// How far x is below the modal surface [m].
inline double depth_below(const TissueModel& model, const TissueState& state, const Vec3& x) noexcept {
  return -model.normal.dot(x - modal_surface(model, state));
}

/// Of F, into the tissue [N].
inline double pressed(const TissueModel& model, const TissueState& state) noexcept {
  return -model.normal.dot(state.force);
}

/// F_r at d [N]
inline double relaxing_force(const TissueModel& model, const TissueState& state, double d) noexcept {
  double force = 0;
  for (std::uint32_t j = 0; j < model.n_branches; ++j)
    force += model.branches[j].stiffness * (d - state.p[j]);
  return force;
}

/// sum g f [N]
inline double flowed(const TissueModel& model, const TissueState& state) noexcept {
  double sum = 0;
  for (std::uint32_t j = 0; j < model.n_branches; ++j) sum += model.branches[j].share * state.f[j];
  return sum;
}

/// F_e, of a force F into the tissue that acts now [N].
inline double staying(const TissueModel& model, const TissueState& state, double F) noexcept {
  return std::max(0.0, (F + flowed(model, state)) / model.stiffening());
}

/// How far the residual has let the surface go under F, along n and across it [m].
inline Vec3 residual_way(const TissueModel& model, const TissueState& state) noexcept {
  const double in = pressed(model, state);
  return model.residual_across * (state.force + in * model.normal) -
         model.contact().give(staying(model, state, in)) * model.normal;
}

/// In modes and branches: sum (w^2 + omega^2 q^2) / 2 + sum k (d - p)^2 / 2 [J]. That of the compliance belongs to the spring.
inline double tissue_energy(const TissueModel& model, const TissueState& state) noexcept {
  double twice = 0;
  for (std::uint32_t i = 0; i < model.n_modes; ++i)
    twice += state.w[i] * state.w[i] + model.modes[i].stiffness * state.q[i] * state.q[i];
  const double d = model.n_branches > 0 ? -model.normal.dot(modal_way(model, state)) : 0.0;
  for (std::uint32_t j = 0; j < model.n_branches; ++j)
    twice += model.branches[j].stiffness * (d - state.p[j]) * (d - state.p[j]);
  return 0.5 * twice;
}

/// What physics tells of one contact: the model, and the state that the hand's sample number `stamp` brought it to.
struct TissueAnswer {
  std::uint64_t tick = 0;   // of the frame
  std::uint32_t tool = 0;   // whose contact it is
  std::uint64_t stamp = 0;  // of the last sample of the hand that has been played
  Vec3 arm = Vec3::Zero();  // from the tip to the point that presses, as the handle lay then [m]
  TissueModel model;
  TissueState state;
};

/// All numbers finite and in bounds, n of length 1, tau above 0, nothing else below 0, and F not out of the tissue. Otherwise it is
/// rejected whole.
bool is_sound(const TissueAnswer& answer, std::uint32_t tool) noexcept;

}  // namespace palpate::haptic
