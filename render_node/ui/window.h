#pragma once
// The picture in a window. Left drag turns the object, right drag moves it, the wheel zooms; w: wires, r: first view,
// Esc: close.

#include <memory>

#include "common/scene/scene.h"
#include "render_node/image/image.h"
#include "render_node/model/view_model.h"
#include "render_node/ui/panels.h"

namespace palpate::render {

class Stage;

/// Is there a display to open a window on (DISPLAY or WAYLAND_DISPLAY)?
bool display_present();

class Window {
 public:
  /// Scene and model must outlive the window. One window a process.
  /// @throws InputError, one line, if no window can be opened
  Window(const Scene& scene, ViewModel& model);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Takes the hand's input, draws, and shows the picture.
  /// @param seen  written, if given: the picture shown
  PanelWishes draw(const PanelFacts& facts, Image* seen = nullptr);

  bool closing() const;   // the person wants to leave
  bool software() const;  // drawn by the processor, not by a graphics card
  ThresholdControl& threshold();

 private:
  struct Glfw;
  void follow_hand();
  std::unique_ptr<Glfw> glfw_;  // first made, last gone
  std::unique_ptr<Stage> stage_;
  double last_draw_ = 0;  // [s]
  bool leave_ = false;
};

}  // namespace palpate::render
