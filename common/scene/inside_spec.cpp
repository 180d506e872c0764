#include "common/scene/inside_spec.h"

#include "common/message/limits.h"
#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/scene.h"
#include "common/scene/section_spec.h"

namespace palpate {

std::string_view inside_name(const std::optional<double>& from) noexcept { return from ? "from" : "none"; }

std::optional<double> inside_of(std::string_view name, double intensity) noexcept {
  return name == "from" ? std::optional(intensity) : std::nullopt;
}

std::vector<std::size_t> bodies_with_inside(const Scene& scene) {
  std::vector<std::size_t> bodies;
  const std::size_t first =
      scene.bodies.size() + scene.connections.size() + bodies_with_section(scene).size();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const bool of_image = scene.bodies[b].lattice == LatticeKind::voxel &&
                          std::holds_alternative<VolumeShape>(scene.bodies[b].shape);
    if (of_image && first + bodies.size() < max_bodies) bodies.push_back(b);
  }
  return bodies;
}

}  // namespace palpate
