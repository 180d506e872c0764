#include "physics_node/boundary/surface.h"

namespace palpate::physics {

Surface mesh_surface(const Body& body, std::uint32_t rgba) {
  const MeshBody& mesh = *body.mesh;
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> vertex(mesh.nodes.size(), none);
  Surface surface;
  for (const MeshTriangle& face : mesh.faces) {
    auto& facet = surface.facets.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& number = vertex[static_cast<std::size_t>(face[k])];
      if (number == none) {
        number = static_cast<std::uint32_t>(surface.cell.size());
        surface.cell.push_back(face[k]);
        surface.rest.push_back(body.rest_position(face[k]));
      }
      facet[k] = number;
    }
    facet[3] = facet[2];
  }
  surface.rgba.assign(surface.facets.size(), rgba);
  surface.site.assign(surface.facets.size(), 0);
  if (!mesh.filled.empty()) surface.hidden = (4 * mesh.filled.size() - mesh.faces.size()) / 2;
  return surface;
}

}  // namespace palpate::physics
