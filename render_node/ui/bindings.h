#pragma once
// Every key of the window and every way of the mouse in it, once: the window acts by this table, the help overlay shows
// it, and docs/reference/window.md lists it word for word (bindings_test).

#include <array>
#include <span>

#include "render_node/ui/hand_events.h"

namespace palpate::render {

enum class Action {
  none,
  // of the window
  help,
  fold,
  pause,
  frame_on,
  hundredth_on,
  reset,
  undo,
  picture,
  close,
  // of the view
  front,
  side,
  top,
  at_tool,
  fit,
  first_view,
  wires,
  ways,
  section,
  section_on,
  section_back,
  inside,
  // of the tool that the mouse leads
  toggle_tool,
  next_tool,
  button,
  turn_up,
  turn_down,
  turn_left,
  turn_right,
  roll_left,
  roll_right
};
inline constexpr int n_actions = 31;  // with none

/// What a row is about; the headings of the help.
enum class Part { window, view, tool };

struct Key {
  int code = 0;  // of GLFW or HandEvents::of_character()
  Action action = Action::none;
};

struct Binding {
  Part part;
  const char* keys;  // as a person reads them
  const char* does;
  std::array<Key, 6> codes = {};  // none: a way of the mouse
};

std::span<const Binding> bindings();

const char* heading_of(Part part);

/// The row that an action stands in; none of Action::none.
const Binding* binding_of(Action action);

/// Times that a key of this action went down since the last picture.
int presses(const HandEvents& events, Action action);
/// A key of this action is down, or was since the last picture.
bool down(const HandEvents& events, Action action);
/// How long the longest held key of this action was down since the last picture, `seconds` ago [s].
double held(const HandEvents& events, Action action, double seconds);

}  // namespace palpate::render
