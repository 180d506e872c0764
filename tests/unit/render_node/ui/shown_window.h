#pragma once
// A window with a cube, a hand for it, and what its pictures are measured by.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "render_node/ui/window.h"
#include "tests/unit/render_node/render_support.h"
// Last: Xlib's macros.
#include "tests/unit/render_node/ui/window_hand.h"

namespace palpate::render::test {

/// A window of this size with a cube of 0.1 m, led by the mouse or not.
struct Shown {
  Shown(const std::string& title, int width, int height, bool pointed) : scene(small_scene()) {
    scene.title = title;
    scene.tools[0].radius = 1e-9;  // it is not lifted before it is put down
    scene.render->size_px = {width, height};
    scene.render->show_panels = true;
    model.emplace(scene);
    window.emplace(scene, *model, pointed ? std::vector<std::uint32_t>{0} : std::vector<std::uint32_t>{});
    facts.interactive = true;
    for (const auto& chunk : chunks_of(cube_surface(12, 0.1, 0xff96b4e6U), 0, 1)) model->take(chunk);
    draw();
    draw();
    hand.emplace(title);
  }
  PanelWishes draw(Image* image = nullptr) { return window->draw(facts, image); }
  void tap(KeySym key) {
    hand->key(key, true);
    hand->key(key, false);
  }
  Scene scene;
  std::optional<ViewModel> model;
  std::optional<render::Window> window;
  PanelFacts facts;
  std::optional<WindowHand> hand;
};

/// Pixels as dark as letters.
inline int ink(const Image& image, int x0, int x1, int y0, int y1) {
  int dark = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) dark += image.at(x, y)[0] < 110 && image.at(x, y)[2] < 130 ? 1 : 0;
  return dark;
}

/// Pixels that differ between two pictures.
inline int differing(const Image& a, const Image& b) {
  int n = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) n += std::equal(a.at(x, y), a.at(x, y) + 3, b.at(x, y)) ? 0 : 1;
  return n;
}

}  // namespace palpate::render::test
