#pragma once
// One tool and the arrow of the force on it. As the papers show it, a tool rests on the surface where its proxy is, however far
// beneath the hand has gone.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>

#include "common/scene/device_spec.h"
#include "common/scene/tool_spec.h"
#include "render_node/gl/lit_program.h"
#include "render_node/gl/solid_drawing.h"
#include "render_node/model/view_model.h"
#include "render_node/view/pixel_box.h"

namespace palpate::render {

class ToolDrawing {
 public:
  /// @param body  that the tool is, drawn as such, without a stick
  ToolDrawing(const ToolSpec& spec, const DeviceSpec& device, std::optional<std::size_t> body);

  struct Wanted {
    bool tool = true, force = true, wire = false;
    double size = 0;               // half the diagonal of all bodies [m]
    double metres_per_newton = 0;  // of the arrow
  };
  /// For bodies of this size, as far as the tool has none of its own. [m]
  void shape(double size);
  /// Where it is drawn from now on: nowhere before a hand was heard.
  void place(const ToolView& view, const ViewModel& model, const Wanted& wanted);

  void draw(const LitProgram& program) const;

  /// How it darkens what is near; nothing where it is not drawn. A tool that is a body does so only where it is pushed.
  const std::optional<Touch>& touch() const noexcept { return touch_; }
  std::optional<std::size_t> body() const noexcept { return body_; }
  double force_limit() const noexcept { return force_limit_; }  // of its device [N]

  /// Pixels in which it is drawn otherwise than at the last call.
  PixelBoxes changed_pixels(const Lens& lens);

 private:
  void place_blades(const Eigen::Vector3d& tip, const ToolView& view);
  Eigen::Vector3d pushed_at(const ToolView& view, const ViewModel& model, const Eigen::Vector3d& at,
                            const Eigen::Vector3d& axis) const;
  struct Placed {
    std::optional<Eigen::Matrix4f> stick, arrow;  // poses; nothing: not drawn
    std::optional<Eigen::Matrix4f> other;         // of the other blade of scissors
    float arrow_length = 0;
    bool wire = false;
    friend bool operator==(const Placed&, const Placed&) = default;
  };

  ToolShape shape_;
  std::optional<std::size_t> body_;
  double radius_ = 0;     // of the tip [m]
  Eigen::Vector3d axis_;  // from the tip up, unit; where the handle is not turned
  double length_ = 0;     // of the stick, or what it is instead [m]; 0: as the picture needs
  double edge_ = 0;       // of a scalpel: from its handle [rad]
  Eigen::Vector3d size_ = Eigen::Vector3d::Zero();  // of a box [m]
  Eigen::Matrix3d attitude_ =
      Eigen::Matrix3d::Identity();  // of a box or of blades, where the handle is not turned
  double force_limit_ = 0;          // [N]
  bool at_hand_ = false;            // is where the hand is, not at the proxy
  ScissorsSpec scissors_;
  SolidDrawing stick_, other_, arrow_;
  Placed placed_, seen_;  // now, and when changed_pixels() was last asked
  PixelBoxes seen_pixels_;
  std::optional<Touch> touch_;
};

}  // namespace palpate::render
