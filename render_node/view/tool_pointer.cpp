#include "render_node/view/tool_pointer.h"

#include <algorithm>

#include "common/message/vec3.h"

namespace palpate::render {

/// At the cursor: on the surface there, or else where it lies.
void ToolPointer::take(const PointerInput& input) {
  const auto surface = input.surface ? input.surface(input.cursor) : std::nullopt;
  if (input.place && !surface) return;
  held_ = true;
  moved_ = false;
  lift_ = lifted_ = surface ? input.lift : 0.0;
  waits_ = wait_s;
  deep_ = -lift_;
  grip_.setZero();
  if (surface) p_ = *surface;
}

/// Comes down on the surface at an even speed.
void ToolPointer::land(double seconds) {
  const double late = std::min(seconds, 0.1);  // Why: a picture that came late must not let it fall
  waits_ -= late;
  if (waits_ > 0) return;
  const double by = std::min(lifted_, lift_ / landing_s * late);
  lifted_ -= by;
  deep_ += by;
}

/// The tip stays, whatever the camera shows under the cursor now. What is behind the eye nobody can lead.
void ToolPointer::grip_anew(const PointerInput& input, const Camera& camera) {
  moved_ = false;
  const auto pixel = camera.project(p_);
  if (!pixel) {
    held_ = false;
    return;
  }
  grip_ = *pixel - input.cursor;
  if (const auto surface = input.surface ? input.surface(*pixel) : std::nullopt)
    deep_ = camera.depth(p_) - camera.depth(*surface);
}

void ToolPointer::move(const PointerInput& input, const Camera& camera) {
  const double step = input.wheel * depth_per_notch * camera.distance() * (input.fine ? 0.1 : 1.0);
  const double before = camera.depth(p_), least = nearest * camera.distance();
  deep_ += step;
  if (!input.follows) {
    p_ -= (std::max(before + step, least) - before) * camera.axes().row(2).transpose();
    return;
  }
  const Eigen::Vector2d pixel = input.cursor + grip_;
  const auto surface = input.surface ? input.surface(pixel) : std::nullopt;
  p_ = camera.at(pixel, std::max(surface ? camera.depth(*surface) + deep_ : before + step, least));
}

void ToolPointer::follow(const PointerInput& input, const Camera& camera, double seconds) {
  const Eigen::Matrix4d clip = camera.projection() * camera.view();
  moved_ = moved_ || clip != clip_;
  clip_ = clip;
  if (input.let_go || (input.toggle && held_))
    held_ = false;
  else if (input.toggle || input.place)
    take(input);
  if (held_ && moved_ && input.follows) grip_anew(input, camera);
  buttons_ = held_ ? input.buttons : 0;
  if (!held_) return;
  land(seconds);
  move(input, camera);
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
