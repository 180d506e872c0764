#pragma once
// What the haptic node says of a tool in the note of its status: "RIGHTS; NAME: STATE (REASON); NAME: ...".

#include <string>
#include <string_view>

namespace palpate::render {

struct HandState {
  std::string state, reason;  // e.g. "ready", "inside the tissue, move out"; empty: not said
};

HandState hand_state(std::string_view note, std::string_view tool);

}  // namespace palpate::render
