#pragma once
// The proxy: the point nearest to the hand that no plane forbids.
//
//   min |p - x|  subject to  n_i.(p - q_i) >= 0,      p = x + sum of lambda_i n_i,  lambda_i >= 0
//
// Source: Mendoza & Laugier, local haptic model, eq. (4) and (5). Deviation: (5) is garbled in print and asks for
// equality on all planes, which is not the minimum; here active sets of up to three planes are tried and the one
// that satisfies the Karush-Kuhn-Tucker conditions is taken.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "common/math/vec3.h"

namespace palpate::haptic {

inline constexpr std::size_t max_planes = 8;

struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();  // unit, into the allowed side
  Vec3 point = Vec3::Zero();    // on the plane [m]
};

struct Projection {
  Vec3 point = Vec3::Zero();              // p [m]
  std::array<double, max_planes> push{};  // lambda_i: how far plane i pushes [m], >= 0
  bool feasible = true;                   // false: no point satisfies all planes; `point` is then x
};

/// @param planes  up to max_planes
/// Costs: 1 + m + C(m,2) + C(m,3) small systems. Parallel and dependent planes are allowed.
Projection project_out(std::span<const HalfSpace> planes, const Vec3& x) noexcept;

}  // namespace palpate::haptic
