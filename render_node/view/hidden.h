#pragma once
// Bodies and tools that a person does not want to see now. Only the eye knows: they are felt and move as ever.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace palpate::render {

struct Hidden {
  std::vector<bool> bodies;  // as in the scene, its connections behind; may be shorter
  std::vector<bool> tools;   // as in the scene; may be shorter
  friend bool operator==(const Hidden&, const Hidden&) = default;
};

/// What of the bodies a person sees.
struct SeenBodies {
  const Hidden& hidden;
  std::optional<Eigen::Vector4f> cut;  // what is taken away (section_cut.h)
};

/// Those that the list has no word for are shown.
inline bool is_hidden(const std::vector<bool>& hidden, std::size_t i) {
  return i < hidden.size() && hidden[i];
}

}  // namespace palpate::render
