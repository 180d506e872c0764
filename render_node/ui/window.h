#pragma once
// The picture in a window, with the keys and ways of the mouse of bindings.h. Nothing that a hand does is lost
// between two pictures (hand_events.h).

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "render_node/image/image.h"
#include "render_node/model/view_model.h"
#include "render_node/ui/bindings.h"
#include "render_node/ui/hand_events.h"
#include "render_node/ui/panels.h"
#include "render_node/ui/tool_leading.h"

namespace palpate::render {

class Stage;

/// Is there a display to open a window on (DISPLAY or WAYLAND_DISPLAY)?
bool display_present();

class Window {
 public:
  /// Scene and model must outlive the window. One window a process.
  /// @param pointed  tools of the scene that the mouse leads
  /// @throws InputError, one line, if no window can be opened
  Window(const Scene& scene, ViewModel& model, const std::vector<std::uint32_t>& pointed = {});
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Takes the hand's input, draws, and shows the picture.
  /// @param seen  written, if given: the picture shown
  PanelWishes draw(const PanelFacts& facts, Image* seen = nullptr);

  /// Says something over the picture for some seconds; newer words replace older ones.
  void say(const std::string& words);

  /// The tools that the mouse leads, once there is a body to see.
  std::vector<ToolPointer>& pointers() noexcept { return leading_.pointers(); }

  bool closing() const;   // the person wants to leave
  bool software() const;  // drawn by the processor, not by a graphics card
  ThresholdControl& threshold();
  SectionControl& section();
  InsideControl& inside();
  ColourKind& colour();

 private:
  struct Glfw;
  void hear();
  CursorNow cursor_now(double wheel) const;
  void move_camera(const CursorNow& cursor);
  void perform_keys(PanelWishes& wishes);
  void perform(Action action, PanelWishes& wishes);
  void look_at_tool();
  SeenBodies seen_bodies() const;

  HandEvents events_;
  std::unique_ptr<Glfw> glfw_;  // made before, and gone after, all that draws
  std::unique_ptr<Stage> stage_;
  const Scene& scene_;
  ViewModel& model_;
  ToolLeading leading_;
  double last_draw_ = 0;  // [s]
  std::string words_;     // of say(), and until when [s]
  double words_until_ = 0;
  bool help_ = false, folded_ = false, leave_ = false;
};

}  // namespace palpate::render
