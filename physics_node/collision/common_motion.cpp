#include "physics_node/collision/common_motion.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr double clearly_slower = 0.25;

}  // namespace

Vec3 common_velocity(const std::vector<ContactBody>& bodies, double least) noexcept {
  Eigen::AlignedBox3d box;
  double most = 0;
  for (const auto& body : bodies)
    for (const Vec3& v : body.candidates().v_move()) {
      box.extend(v);
      most = std::max(most, v.squaredNorm());
    }
  const double fastest = std::sqrt(most);
  if (!(fastest > least) || 0.5 * box.diagonal().norm() > clearly_slower * fastest) return Vec3::Zero();
  return box.center();
}

}  // namespace palpate::physics
