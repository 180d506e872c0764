#pragma once
// A section: bodies shown as if a plane across an axis of the world cut them open where they rest. Only what is seen is
// cut: the tissue stays whole, and its section moves with it.

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "common/scene/scene_fwd.h"

namespace palpate {

struct SectionSpec {
  int axis = 0;   // x, y, z
  double at = 0;  // [m]
  friend bool operator==(const SectionSpec&, const SectionSpec&) = default;
};

/// As a Command names it: "x", "y", "z"; "none" where there is none.
std::string_view section_name(const std::optional<SectionSpec>& section) noexcept;
/// What a Command says. Nothing: none, or another name.
std::optional<SectionSpec> section_of(std::string_view name, double at) noexcept;

/// The bodies whose section is shown, those of cells, in their order. To the eye each is one more body: number k
/// stands behind those of the scene and its connections. @return no more than there are numbers for
std::vector<std::size_t> bodies_with_section(const Scene& scene);

}  // namespace palpate
