#include "haptic_node/contact/raw_planes.h"

#include <algorithm>

#include "common/message/vec3.h"

namespace palpate::haptic {

ContactResult raw_plane_force(const ContactPatch& patch, const HandMotion& hand, double stiffness,
                              double damping, double limit) noexcept {
  ContactResult out;
  out.proxy = hand.x;
  if (patch.n_facets == 0) return out;
  const Vec3 n = vec(patch.facets[0].normal);
  const double depth = -n.dot(hand.x - vec(patch.facets[0].point));
  if (depth <= 0) return out;
  out.force = std::clamp(stiffness * depth - damping * n.dot(hand.v), 0.0, limit) * n;
  out.proxy = hand.x + depth * n;
  out.depth = depth;
  out.stored = 0.5 * stiffness * depth * depth;
  out.n_planes = 1;
  return out;
}

ContactResult direct_force(const ToolWrench& wrench, const HandMotion& hand, double stiffness) noexcept {
  ContactResult out;
  out.force = vec(wrench.force);
  out.torque = vec(wrench.moment) + (vec(wrench.set_point) - vec(wrench.tip)).cross(out.force);
  out.proxy = hand.x + out.force / stiffness;
  out.depth = out.force.norm() / stiffness;
  out.n_planes = out.force.isZero() && out.torque.isZero() ? 0 : 1;
  return out;
}

}  // namespace palpate::haptic
