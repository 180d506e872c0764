#pragma once
// The proxy found another way: every subset of up to three planes solved in long double, the nearest feasible point
// kept. It knows nothing of multipliers and their signs.

#include <cstdint>
#include <span>

#include "haptic_node/contact/plane_projection.h"

namespace palpate::bench {

using Vec3L = Eigen::Matrix<long double, 3, 1>;

/// @return false if no subset gives a feasible point
bool nearest_by_enumeration(std::span<const haptic::HalfSpace> planes, const Vec3& x, Vec3L& nearest);

struct ProxyErrors {
  std::size_t sets = 0, infeasible = 0;
  long double distance = 0;           // largest, between the two points [m]
  std::size_t conditions_broken = 0;  // p = x + sum push n, push >= 0, at most three of them, and feasible
  std::size_t missed = 0;             // feasible by the one, not by the other
};

/// Random sets of 1 to 8 planes and points within some centimetres.
ProxyErrors compare_with_oracle(std::size_t sets, std::uint64_t seed);

}  // namespace palpate::bench
