#pragma once
// The equilibrium of an elastic lattice, found without stepping: the exact answer that stepping must come to.

#include <Eigen/Core>

#include "physics_node/body/body.h"

namespace palpate::bench {

/// Displacements of all masses at rest under gravity, held masses at zero, in the order of lattice.masses (3 x n_masses).
///
///   sum over elements of k1 (l - L) u_ij + m g = 0, by Newton's method:
///   K dx = r,   K_ij = -k1 [u u^T + (1 - L/l)(1 - u u^T)],   started from the linear answer K u = f
///
/// by sparse Cholesky factors, so for some thousand masses at most. Written apart from the kernels on purpose. Elastic bodies
/// of one material only; some mass must be held.
Eigen::Matrix3Xd equilibrium(const physics::Body& body, const Vec3& gravity);

/// The linear answer K u = f alone, to seven digits, for any number of masses.
Eigen::Matrix3Xd linear_equilibrium(const physics::Body& body, const Vec3& gravity);

}  // namespace palpate::bench
