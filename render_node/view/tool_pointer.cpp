#include "render_node/view/tool_pointer.h"

#include <algorithm>

#include "common/message/vec3.h"

namespace palpate::render {

void ToolPointer::follow(const PointerInput& input, const Camera& camera, double seconds) {
  if (input.toggle) held_ = !held_;
  const bool placed = input.place && input.surface;
  if (placed || (input.toggle && held_)) {
    held_ = true;
    deep_ = 0;
    if (input.surface) p_ = *input.surface;
  }
  if (input.let_go) held_ = false;
  buttons_ = held_ ? input.buttons : 0;
  if (!held_) return;

  const double step = depth_per_notch * camera.distance() * (input.fine ? 0.1 : 1.0);
  const double before = camera.depth(p_);
  deep_ += input.wheel * step;
  const double wish =
      input.follows && input.surface ? camera.depth(*input.surface) + deep_ : before + input.wheel * step;
  const double depth = std::max(wish, nearest * camera.distance());
  if (input.follows)
    p_ = camera.at(input.cursor, depth);
  else
    p_ -= (depth - before) * camera.axes().row(2).transpose();

  if (const double by = input.turn.norm(); by > 0) {
    const Vec3 axis = camera.axes().transpose() * input.turn / by;
    q_ = (Eigen::AngleAxisd(std::min(by, 1.0) * turn_speed * seconds, axis) * q_).normalized();
  }
}

Pointer ToolPointer::message(std::int64_t now_ns) {
  Pointer pointer;
  pointer.tool = tool_;
  pointer.tick = ++tick_;
  pointer.stamp_ns = now_ns;
  pointer.p_W = array(p_);
  pointer.q_W = {q_.w(), q_.x(), q_.y(), q_.z()};
  pointer.buttons = buttons_;
  pointer.held = held_ ? 1 : 0;
  return pointer;
}

}  // namespace palpate::render
