#pragma once
// Bodies and tools that a person does not want to see now. Only the eye knows: they are felt and move as ever.

#include <cstddef>
#include <vector>

namespace palpate::render {

struct Hidden {
  std::vector<bool> bodies;  // as in the scene, its connections behind; may be shorter
  std::vector<bool> tools;   // as in the scene; may be shorter
};

/// Those that the list has no word for are shown.
inline bool is_hidden(const std::vector<bool>& hidden, std::size_t i) {
  return i < hidden.size() && hidden[i];
}

}  // namespace palpate::render
