#pragma once
// Camera, picture and panels together, for a window or a headless frame: whoever owns the OpenGL context makes one.

#include "common/scene/scene_fwd.h"
#include "render_node/gl/painter.h"
#include "render_node/ui/imgui_context.h"
#include "render_node/ui/imgui_drawing.h"
#include "render_node/ui/panels.h"
#include "render_node/view/camera.h"

namespace palpate::render {

class Stage {
 public:
  /// @param height  of the picture, for the size of text [px]  @param samples  a pixel; 0: no smoothing of edges
  /// Scene and model must outlive the stage.
  Stage(const Scene& scene, ViewModel& model, int height, int samples);

  /// Makes this stage's ImGui context current; call before feeding input or drawing.
  void make_current() const { imgui_.make_current(); }

  /// Draws into the bound framebuffer, which has one sample a pixel. The ImGui frame must not be open; `seconds` is the wall time since the last one.
  PanelWishes draw(const PanelFacts& facts, int width, int height, float seconds);

  Camera& camera() noexcept { return camera_; }
  PaintOptions& options() noexcept { return options_; }
  ThresholdControl& threshold() noexcept { return threshold_; }
  SectionControl& section() noexcept { return section_; }
  InsideControl& inside() noexcept { return inside_; }
  Painter& painter() noexcept { return painter_; }

 private:
  /// Of all bodies as they were first seen, down to the floor: what falls stays in sight.
  Eigen::AlignedBox3d box_with_floor() const;
  std::optional<SectionSpec> section_in(const Eigen::AlignedBox3d& box) const;

  const Scene& scene_;
  ViewModel& model_;
  Camera camera_;
  PaintOptions options_;
  ThresholdControl threshold_;
  SectionControl section_;
  InsideControl inside_;
  Painter painter_;
  ImguiContext imgui_;
  ImguiDrawing panels_;
};

}  // namespace palpate::render
