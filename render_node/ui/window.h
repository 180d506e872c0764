#pragma once
// The picture in a window. Nothing that a hand does is lost between two pictures (hand_events.h). Left drag turns the object, right drag moves it, the wheel zooms; w: wires, r: first view,
// Esc: close. Of the tools that the mouse leads, t takes one or lets it go, Tab goes to the next; while one is held, the
// mouse and its wheel move it, arrows and page keys turn it, Space is its button.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "render_node/image/image.h"
#include "render_node/model/view_model.h"
#include "render_node/ui/hand_events.h"
#include "render_node/ui/panels.h"
#include "render_node/view/tool_pointer.h"

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

  /// The tools that the mouse leads, once there is a body to see.
  std::vector<ToolPointer>& pointers() noexcept { return pointers_; }

  bool closing() const;   // the person wants to leave
  bool software() const;  // drawn by the processor, not by a graphics card
  ThresholdControl& threshold();

 private:
  struct Glfw;
  void hear();
  void lay_out_pointers();
  std::optional<Vec3> surface_under_cursor(std::uint32_t tool) const;
  void follow_hand(double wheel, double seconds);
  void lead_tool(double wheel, double seconds);
  HandEvents events_;
  std::unique_ptr<Glfw> glfw_;  // made before, and gone after, all that draws
  std::unique_ptr<Stage> stage_;
  const Scene& scene_;
  ViewModel& model_;
  std::vector<std::uint32_t> pointed_;
  std::vector<ToolPointer> pointers_;  // empty until a body is seen
  std::size_t led_ = 0;                // which of them the keys are about
  double last_draw_ = 0;               // [s]
  bool leave_ = false;
};

}  // namespace palpate::render
