#pragma once
// What a contact feels of a body: its modes there, and how much more the body gives at once.

#include <span>

#include "physics_node/body/mass_share.h"
#include "physics_node/reduced/lowest_modes.h"

namespace palpate::physics {

/// The place of a contact, z = sum of share_j x_j, under a force F that is shared out alike:
///
///   z = Psi q,   q_i'' + beta omega_i^2 q_i' + omega_i^2 q_i = (Psi^T F)_i,   Psi = sum of share_j Phi_j
///
/// beta the viscosity over the modulus [s]. To the modes of the body come up to three that only this contact wakes: the best (Rayleigh, Ritz) in
/// the body's own answers to a steady force there, less what the modes do, x = (K + s M)^-1 (b - M Phi Psi^T). With them a steady force is
/// answered by the whole body's compliance, and what is left out of a slow one falls with the fourth power of its frequency.
/// What the lowest modes leave, given as a compliance that answers at once, is 4 to 15 times as far off at 20 Hz: bench touch.
/// Source: Rubin 1975 (residual inertia), MacNeal 1971 (residual compliance); as modes, damped as the body is: ours.
struct DrivingPoint {
  Eigen::Matrix3Xd psi;    // (3, n + added), those of the body first [kg^-1/2]
  Eigen::VectorXd omega2;  // of all [1/s^2]
  Eigen::MatrixXd
      added;  // shape of those that came to the body's, M-orthonormal (3 n_rows, 0 to 3) [kg^-1/2]
  bool converged = false;  // all solves

  /// z / F of a force that swings with w [rad/s]. [m/N]
  Eigen::Matrix3cd compliance(double beta, double w) const;
};

/// Three solves. @param contact  nodes that are held bear their share and do not move
DrivingPoint driving_point(LinearAnswer& body, const VibrationModes& modes,
                           std::span<const MassShare> contact, const Crew& crew = {});

}  // namespace palpate::physics
