#include "physics_node/collision/common_motion.h"

#include <algorithm>

#include "physics_node/collision/usual_motion.h"

namespace palpate::physics {
namespace {

constexpr double clearly_slower = 0.25;
constexpr double most_of_them = 0.75;

}  // namespace

Vec3 common_velocity(const ContactBody& body, double least) noexcept {
  const auto& v = body.candidates().v_move();
  const Vec3 usual = usual_motion(v.size(), [&](std::size_t n) { return v[n]; });
  if (!(usual.squaredNorm() > least * least)) return Vec3::Zero();
  double most = 0;
  for (const Vec3& one : v) most = std::max(most, one.squaredNorm());
  const double slow = clearly_slower * clearly_slower * most;
  const auto n_slow =
      std::count_if(v.begin(), v.end(), [&](const Vec3& one) { return (one - usual).squaredNorm() <= slow; });
  return static_cast<double>(n_slow) < most_of_them * static_cast<double>(v.size()) ? Vec3::Zero() : usual;
}

}  // namespace palpate::physics
