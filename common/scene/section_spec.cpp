#include "common/scene/section_spec.h"

#include <algorithm>

#include "common/message/limits.h"
#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/scene.h"

namespace palpate {
namespace {

constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};

}  // namespace

std::string_view section_name(const std::optional<SectionSpec>& section) noexcept {
  return section ? axes[static_cast<std::size_t>(section->axis)] : "none";
}

std::optional<SectionSpec> section_of(std::string_view name, double at) noexcept {
  const auto found = std::ranges::find(axes, name);
  if (found == axes.end()) return std::nullopt;
  return SectionSpec{static_cast<int>(found - axes.begin()), at};
}

std::vector<std::size_t> bodies_with_section(const Scene& scene) {
  std::vector<std::size_t> bodies;
  const std::size_t first = scene.bodies.size() + scene.connections.size();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const bool of_cells = scene.bodies[b].lattice == LatticeKind::voxel &&
                          !std::holds_alternative<MeshShape>(scene.bodies[b].shape);
    if (of_cells && first + bodies.size() < max_bodies) bodies.push_back(b);
  }
  return bodies;
}

}  // namespace palpate
