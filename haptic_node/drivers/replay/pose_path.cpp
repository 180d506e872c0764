#include "haptic_node/drivers/replay/pose_path.h"

#include <fmt/format.h>

#include <cmath>

namespace palpate::haptic::replay {

std::string PosePath::take(Pose pose) {
  if (!poses.empty() && !(pose.t > poses.back().t))
    return fmt::format("{} s follows {} s; times must grow", pose.t, poses.back().t);
  if (!pose.p.allFinite()) return "a position that is not finite; write metres or millimetres";
  if (!(std::abs(pose.q.norm() - 1.0) < 1e-3))
    return fmt::format("the attitude has length {:.6g}; a unit quaternion is wanted", pose.q.norm());
  pose.q.normalize();
  poses.push_back(pose);
  return {};
}

Pose PosePath::at(double t, std::size_t& hint) const noexcept {
  if (hint >= poses.size() || t < poses[hint].t) hint = 0;
  while (hint + 1 < poses.size() && t >= poses[hint + 1].t) ++hint;
  const Pose& from = poses[hint];
  if (hint + 1 == poses.size() || t <= from.t) return from;
  const Pose& to = poses[hint + 1];
  const double s = (t - from.t) / (to.t - from.t);
  return {t, from.p + s * (to.p - from.p), from.q.slerp(s, to.q), from.buttons};
}

}  // namespace palpate::haptic::replay
