#include "physics_node/contact/norton_spring.h"

#include <Eigen/Geometry>

namespace palpate::physics {

Mat6 NortonSpring::tangent() const noexcept {
  Vec6 g, h;
  g << normal, arm.cross(normal);
  h << Vec3::Zero(), spread.cross(normal);
  return stiffness * (g * g.transpose() + h * h.transpose());
}

}  // namespace palpate::physics
