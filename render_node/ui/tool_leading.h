#pragma once
// The tools that the mouse leads: which of them the keys are about, and what keys and mouse make of it. No window in
// here.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "render_node/model/view_model.h"
#include "render_node/ui/hand_events.h"
#include "render_node/view/camera.h"
#include "render_node/view/hidden.h"
#include "render_node/view/tool_pointer.h"
#include "render_node/view/touch_surface.h"

namespace palpate::render {

/// The cursor of this picture.
struct CursorNow {
  Eigen::Vector2d pixel = {0, 0};  // [px]
  bool in_picture = false;         // in the window, and over no panel
  bool drags = false;              // a button moves the camera
  double wheel = 0;                // notches away from the person
  bool fine = false;               // a tenth of the way per notch
  bool typing = false;             // keys go into a field of a panel
};

class ToolLeading {
 public:
  /// @param pointed  tools of the scene that the mouse leads. Scene and model must outlive this.
  ToolLeading(const Scene& scene, const ViewModel& model, const std::vector<std::uint32_t>& pointed)
      : scene_(scene), model_(model), pointed_(pointed) {}

  /// Once there is a body to see: a tool that is a body lies where its body is; another before the surface in the
  /// middle of the view, or before all bodies.
  void lay_out(const Camera& camera);

  /// @param seconds  since the last picture
  void lead(const HandEvents& events, const CursorNow& cursor, const Camera& camera, const SeenBodies& seen,
            double seconds);

  bool any() const noexcept { return !pointed_.empty(); }
  bool holds() const { return !pointers_.empty() && pointers_[led_].held(); }
  const ToolPointer* led() const { return pointers_.empty() ? nullptr : &pointers_[led_]; }
  std::vector<ToolPointer>& pointers() noexcept { return pointers_; }  // empty until a body is seen

 private:
  bool keeps_to_surface() const;
  std::span<const BodyPicture> tissue() const;
  PointerInput input_from(const HandEvents& events, const CursorNow& cursor, const Camera& camera,
                          const SeenBodies& seen, double seconds);

  const Scene& scene_;
  const ViewModel& model_;
  std::vector<std::uint32_t> pointed_;
  std::vector<ToolPointer> pointers_;
  TouchSurface touch_;
  std::size_t led_ = 0;
};

}  // namespace palpate::render
