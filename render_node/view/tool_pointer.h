#pragma once
// A tool led by mouse and keys. Taken, it starts on the surface under the cursor, where there is one. Then the tip follows the
// cursor over that surface, as deep in it as the wheel says; where there is none, in the plane through the tip that
// faces the camera. When the camera moves the tool stays, and from there on the tip keeps its way from the cursor.
// Keys turn the tool about the axes of the camera.
//
//   p = eye + (s(c) + d) r(c),    c = cursor + g,    d := d + step (wheel towards the scene)
//
//   r(c) the ray of pixel c, 1 deep;  s(c) depth of the surface there;  g = 0 where it is taken, and such that p stays where the
//   camera has moved;  d = -lift where it is taken on a surface, from where it comes down to 0 by itself: tissue feels a tool
//   that comes from outside, and that may have lain in it before
//
// No window and no keys in here: ui/ says what the person did.

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>

#include "common/message/messages.h"
#include "render_node/view/camera.h"

namespace palpate::render {

/// What mouse and keys did since the last picture.
struct PointerInput {
  Eigen::Vector2d cursor = {0, 0};  // [px]
  bool follows = true;              // false: the cursor is over the panels, or a button moves the camera
  double wheel = 0;                 // notches away from the person, into the scene
  bool fine = false;                // a tenth of the way per notch
  Vec3 turn = Vec3::Zero();         // keys held, -1..1 about right, up and towards the viewer
  bool toggle = false;              // take it, or let it go
  bool place = false;  // on the surface under the cursor, taken; nothing happens where there is none
  bool let_go = false;
  // The surface under a pixel [m], or nothing; none at all: the tool keeps to a plane.
  std::function<std::optional<Vec3>(const Eigen::Vector2d&)> surface;
  double lift = 0;            // how far before the surface it is taken [m]
  std::uint32_t buttons = 0;  // bit i: button i of the tool
};

class ToolPointer {
 public:
  static constexpr double depth_per_notch = 0.005;  // of the distance between eye and target
  static constexpr double turn_speed = 1.0;         // [rad/s]
  static constexpr double wait_s = 0.5;             // Why: forces come in over that time after arming
  static constexpr double landing_s = 0.5;          // from where it is lifted down to the surface
  static constexpr double nearest = 0.02;           // before the eye, of the distance between eye and target

  /// @param tool  as in the scene  @param p  where it lies before it is taken [m]
  ToolPointer(std::uint32_t tool, const Vec3& p) : tool_(tool), p_(p) {}

  /// @param seconds  since the last picture. A tool that is not held stays where it is.
  void follow(const PointerInput& input, const Camera& camera, double seconds);
  void let_go() { held_ = false; }

  bool held() const { return held_; }
  std::uint32_t tool() const { return tool_; }
  const Vec3& position() const { return p_; }
  const Eigen::Quaterniond& attitude() const { return q_; }

  /// What is published to the haptic node; each call counts as one sample.
  Pointer message(std::int64_t now_ns);

 private:
  void take(const PointerInput& input);
  void grip_anew(const PointerInput& input, const Camera& camera);
  void land(double seconds);
  void move(const PointerInput& input, const Camera& camera);

  std::uint32_t tool_;
  Vec3 p_;                                                 // [m]
  double deep_ = 0;                                        // in the surface [m]
  double lift_ = 0, lifted_ = 0;                           // where it was taken, and what is left of that [m]
  double waits_ = 0;                                       // before it comes down [s]
  Eigen::Vector2d grip_ = Eigen::Vector2d::Zero();         // from the cursor to the tip [px]
  Eigen::Matrix4d clip_ = Eigen::Matrix4d::Zero();         // of the camera, in the last picture
  bool moved_ = false;                                     // it has moved, and p_ has not followed since
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();  // tool to world
  std::uint32_t buttons_ = 0;
  bool held_ = false;
  std::uint64_t tick_ = 0;
};

}  // namespace palpate::render
