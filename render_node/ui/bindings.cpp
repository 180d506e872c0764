#include "render_node/ui/bindings.h"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace palpate::render {
namespace {

using A = Action;

constexpr Binding table[] = {
    {Part::window,
     "F1, ?",
     "this help, or away with it",
     {{{GLFW_KEY_F1, A::help}, {HandEvents::of_character('?'), A::help}}}},
    {Part::window, "F2", "fold the column on the left, or unfold it", {{{GLFW_KEY_F2, A::fold}}}},
    {Part::window, "P", "pause, or go on", {{{GLFW_KEY_P, A::pause}}}},
    {Part::window,
     ". and >",
     "stand still; go on by a frame of the tissue, or by a hundredth of a second",
     {{{HandEvents::of_character('.'), A::frame_on}, {HandEvents::of_character('>'), A::hundredth_on}}}},
    {Part::window,
     "Backspace",
     "reset: tissue as at the start, a device at fault opened anew",
     {{{GLFW_KEY_BACKSPACE, A::reset}}}},
    {Part::window, "Z", "undo: tissue as before the last stroke of a blade", {{{GLFW_KEY_Z, A::undo}}}},
    {Part::window, "F12", "save a picture of the window", {{{GLFW_KEY_F12, A::picture}}}},
    {Part::window, "Esc", "close the help, then the window", {{{GLFW_KEY_ESCAPE, A::close}}}},
    {Part::view, "left drag", "turn the view", {}},
    {Part::view, "right drag", "move the view", {}},
    {Part::view, "wheel", "zoom, while no tool is held", {}},
    {Part::view,
     "1, 2, 3",
     "from the front (along +y), the side (-x), the top (-z)",
     {{{GLFW_KEY_1, A::front},
       {GLFW_KEY_KP_1, A::front},
       {GLFW_KEY_2, A::side},
       {GLFW_KEY_KP_2, A::side},
       {GLFW_KEY_3, A::top},
       {GLFW_KEY_KP_3, A::top}}}},
    {Part::view, "4", "near, at the tool", {{{GLFW_KEY_4, A::at_tool}, {GLFW_KEY_KP_4, A::at_tool}}}},
    {Part::view, "5", "all bodies in the picture", {{{GLFW_KEY_5, A::fit}, {GLFW_KEY_KP_5, A::fit}}}},
    {Part::view, "R", "the first view", {{{GLFW_KEY_R, A::first_view}}}},
    {Part::view, "W", "edges as wires, or surfaces", {{{GLFW_KEY_W, A::wires}}}},
    {Part::view,
     "C",
     "colours: how far tissue is from rest, its strain, its stress, the pressure in it, where it is awake, "
     "or its own",
     {{{GLFW_KEY_C, A::ways}}}},
    {Part::view, "X", "cut open across x, y, z, or whole again", {{{GLFW_KEY_X, A::section}}}},
    {Part::view,
     "[, ]",
     "move the cut by a hundredth",
     {{{GLFW_KEY_LEFT_BRACKET, A::section_back}, {GLFW_KEY_RIGHT_BRACKET, A::section_on}}}},
    {Part::view, "I", "see what lies inside, through the skin, or no more", {{{GLFW_KEY_I, A::inside}}}},
    {Part::tool, "click", "take it, on the tissue under the cursor", {}},
    {Part::tool, "mouse", "lead it over the tissue", {}},
    {Part::tool, "wheel", "press deeper, or lift; with Shift a tenth", {}},
    {Part::tool, "right click", "let it go", {}},
    {Part::tool, "T", "take it, or let it go", {{{GLFW_KEY_T, A::toggle_tool}}}},
    {Part::tool, "Tab", "the next tool", {{{GLFW_KEY_TAB, A::next_tool}}}},
    {Part::tool, "Space", "its button", {{{GLFW_KEY_SPACE, A::button}}}},
    {Part::tool,
     "arrows",
     "turn it about the camera's axes to the right and up",
     {{{GLFW_KEY_UP, A::turn_up},
       {GLFW_KEY_DOWN, A::turn_down},
       {GLFW_KEY_LEFT, A::turn_left},
       {GLFW_KEY_RIGHT, A::turn_right}}}},
    {Part::tool,
     "PgUp, PgDn",
     "turn it in the picture",
     {{{GLFW_KEY_PAGE_UP, A::roll_left}, {GLFW_KEY_PAGE_DOWN, A::roll_right}}}},
};

/// Calls `each(code)` for every key of an action.
template <class Each>
void for_codes(Action action, Each each) {
  for (const Binding& binding : table)
    for (const Key& key : binding.codes)
      if (key.code != 0 && key.action == action) each(key.code);
}

}  // namespace

std::span<const Binding> bindings() { return table; }

const char* heading_of(Part part) {
  return part == Part::window ? "Window" : part == Part::view ? "View" : "Tool led by the mouse";
}

const Binding* binding_of(Action action) {
  for (const Binding& binding : table)
    for (const Key& key : binding.codes)
      if (key.code != 0 && key.action == action) return &binding;
  return nullptr;
}

int presses(const HandEvents& events, Action action) {
  int n = 0;
  for_codes(action, [&](int code) { n += events.presses(code); });
  return n;
}

bool down(const HandEvents& events, Action action) {
  bool any = false;
  for_codes(action, [&](int code) { any = any || events.down(code); });
  return any;
}

double held(const HandEvents& events, Action action, double seconds) {
  double longest = 0;
  for_codes(action, [&](int code) { longest = std::max(longest, events.held(code, seconds)); });
  return longest;
}

}  // namespace palpate::render
