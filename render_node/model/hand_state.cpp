#include "render_node/model/hand_state.h"

namespace palpate::render {

HandState hand_state(std::string_view note, std::string_view tool) {
  const std::string head = "; " + std::string(tool) + ": ";
  const auto at = note.find(head);
  if (at == note.npos) return {};
  const std::string_view words = note.substr(at + head.size());
  const auto bracket = words.find_first_of("(;");
  std::string_view state = words.substr(0, bracket);
  while (state.ends_with(' ')) state.remove_suffix(1);
  if (bracket == words.npos || words[bracket] == ';') return {std::string(state), {}};
  const std::string_view reason = words.substr(bracket + 1);
  return {std::string(state), std::string(reason.substr(0, reason.find(')')))};
}

}  // namespace palpate::render
