#pragma once
// The column of numbers on the left, in windows and in headless frames alike, and the wishes a hand expresses there. What
// a person must know stands first; plots give way where the picture is low, and what still does not fit scrolls.

#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "render_node/image/image.h"
#include "render_node/model/inside_control.h"
#include "render_node/model/section_control.h"
#include "render_node/model/threshold_control.h"
#include "render_node/model/view_model.h"
#include "render_node/ui/bindings.h"
#include "render_node/view/hidden.h"
#include "render_node/view/tool_pointer.h"

namespace palpate::render {

/// What the panels show besides the model.
struct PanelFacts {
  double t = 0;                        // simulated time [s]
  double arrow_metres_per_newton = 0;  // 0: not known yet
  bool interactive = false;            // a window: with slider and buttons
  bool paused = false;
  const ToolPointer* pointer = nullptr;  // the tool that the mouse leads, if any
  bool help = false;                     // is shown
  bool folded = false;                   // the column is
  std::string words;                     // over the picture; empty: none
};

/// What the person asked for in this frame.
struct PanelWishes {
  bool threshold_released = false;  // ThresholdControl has the value
  bool section_released = false;
  bool inside_released = false;
  std::vector<Action> actions;  // by buttons, as if by keys
  // What of buttons and keys is not the window's own.
  bool paused = false;                   // it should be
  int frames_on = 0, hundredths_on = 0;  // to stand still after: of the tissue; of a second
  bool reset = false, undo = false;
  std::optional<Image> picture;  // to be saved: of the window as it is
};

inline constexpr float panel_width = 308;  // [px] at a picture height of 720

/// Width of the column in a picture where it is not folded: at most two fifths of it [px].
float panel_width_in(float picture_width, float scale);

/// What the column moves.
struct PanelControls {
  ThresholdControl& threshold;
  SectionControl& section;
  InsideControl& inside;
  Hidden& hidden;  // by its list of bodies and tools
};

/// Lays out the column in the current ImGui frame. @param scale  of all lengths, 1 at 720 px
PanelWishes lay_out_panels(const Scene& scene, const ViewModel& model, const PanelFacts& facts,
                           const PanelControls& controls, float scale);

/// What is left of a folded column: a button that unfolds it.
PanelWishes lay_out_folded();

}  // namespace palpate::render
