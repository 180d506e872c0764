#pragma once
// One point that presses a surface through a compliance, with Coulomb's friction:
//
//   e = C F + g,    g . n = 0,    |F_t| <= mu F_n,    g = 0 or F_t = mu F_n t
//
// e from the unloaded surface to the point, F on the surface, n out of it, F_n = -n . F, g what has slid.
// Deviation: the direction of sliding t is that of the force that would stick, not of g; they agree where C is isotropic, and
// as sliding goes on.

#include <Eigen/Dense>

#include "common/math/vec3.h"

namespace palpate::haptic {

using Mat3 = Eigen::Matrix3d;

struct FrictionContact {
  Vec3 force = Vec3::Zero();  // on the surface [N]
  Vec3 gap = Vec3::Zero();    // g, along the surface; without contact e's part along it [m]
  bool touching = false;
};

/// @param compliance  C [m/N]; its symmetric part positive
/// @param inverse     of C, where it is known
/// @param e           [m]
/// @param normal      n, of length 1
/// @param friction    mu >= 0
FrictionContact solve_contact(const Mat3& compliance, const Vec3& e, const Vec3& normal,
                              double friction) noexcept;
FrictionContact solve_contact(const Mat3& compliance, const Mat3& inverse, const Vec3& e, const Vec3& normal,
                              double friction) noexcept;

}  // namespace palpate::haptic
