#pragma once
// The column of numbers on the left, in windows and in headless frames alike, and the wishes a hand expresses there.

#include <optional>

#include "common/scene/scene.h"
#include "render_node/model/threshold_control.h"
#include "render_node/model/view_model.h"
#include "render_node/view/tool_pointer.h"

namespace palpate::render {

/// What the panels show besides the model.
struct PanelFacts {
  double t = 0;                        // simulated time [s]
  double arrow_metres_per_newton = 0;  // 0: not known yet
  bool interactive = false;            // a window: with slider and buttons
  bool paused = false;
  const ToolPointer* pointer = nullptr;  // the tool that the mouse leads, if any: with help
};

/// What the person asked for in this frame.
struct PanelWishes {
  bool threshold_moved = false;  // ThresholdControl has the value
  bool threshold_released = false;
  bool pause = false, resume = false, reset = false;
};

inline constexpr float panel_width = 308;  // [px] at a picture height of 720

/// Lays out the column in the current ImGui frame. @param scale  of all lengths, 1 at 720 px
PanelWishes lay_out_panels(const Scene& scene, const ViewModel& model, const PanelFacts& facts,
                           ThresholdControl& threshold, float scale);

}  // namespace palpate::render
