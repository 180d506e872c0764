#pragma once
// What a contact feels of a body: its modes there, and how much more the body gives at once.

#include <span>

#include "physics_node/reduced/lowest_modes.h"

namespace palpate::physics {

struct ContactShare {
  Index node = 0;
  double share = 0;  // of the force, and of the place
};

/// The place of a contact, z = sum of share_j x_j, under a force F that is shared out alike:
///
///   z = Psi q + S_res p,   q_i'' + beta omega_i^2 q_i' + omega_i^2 q_i = (Psi^T F)_i,   Psi = sum of share_j Phi_j
///   M_res p'' + beta K_res p' + K_res p = S_res F
///
/// beta the viscosity over the modulus [s]. The second line is what the modes that were left out do, as far as the body's own answer to a
/// steady force there, x = (K + s M)^-1 (b - M Phi Psi^T), can tell:  S_res = b^T x,  M_res = x^T M x,  K_res = S_res - s M_res.
/// A residual without inertia and damper (MacNeal) is 4 to 20 times as far off at 20 Hz: bench touch.
/// Source: Rubin 1975, residual inertia; MacNeal 1971; the damper of the residual: ours.
struct DrivingPoint {
  Eigen::Matrix3Xd psi;                                        // (3, n) [kg^-1/2]
  Eigen::Matrix3d residual = Eigen::Matrix3d::Zero();          // S_res, symmetric, not below 0 [m/N]
  Eigen::Matrix3d residual_inertia = Eigen::Matrix3d::Zero();  // M_res, the same [m s^2/N]
  double shift = 0;                                            // s [1/s^2]
  bool converged = false;

  /// z / F of a force that swings with w [rad/s]. [m/N]
  Eigen::Matrix3cd compliance(const VibrationModes& modes, double beta, double w) const;
};

/// Three solves. @param contact  nodes that are held bear their share and do not move
DrivingPoint driving_point(LinearAnswer& body, const VibrationModes& modes,
                           std::span<const ContactShare> contact, const Crew& crew = {});

}  // namespace palpate::physics
