#include "physics_node/boundary/surface.h"

namespace palpate::physics {

std::uint32_t inside_colour(std::uint32_t skin) noexcept {
  constexpr double kept[] = {0.8, 0.45, 0.4};  // of red, green, blue. Why: seen beside the skin in any light
  std::uint32_t rgba = skin & 0xFF000000U;
  for (unsigned c = 0; c < 3; ++c)
    rgba |= static_cast<std::uint32_t>(kept[c] * (skin >> 8 * c & 0xFFU)) << 8 * c;
  return rgba;
}

namespace {

/// Takes triangles, and their corners as vertices where they come first.
class MeshSurfaceMaker {
 public:
  explicit MeshSurfaceMaker(const Body& body)
      : body_(body), vertex_(static_cast<std::size_t>(body.capacity()), none) {}

  void take(const MeshTriangle& face, const MeshTriangle& origins, Index site, std::uint32_t rgba) {
    auto& facet = surface.facets.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& number = vertex_[static_cast<std::size_t>(face[k])];
      if (number == none) {
        number = static_cast<std::uint32_t>(surface.cell.size());
        surface.cell.push_back(face[k]);
        surface.rest.push_back(body_.mesh->model.mesh.nodes[static_cast<std::size_t>(origins[k])]);
      }
      facet[k] = number;
    }
    facet[3] = facet[2];
    surface.rgba.push_back(rgba);
    surface.site.push_back(static_cast<std::uint32_t>(site));
  }

  Surface surface;

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  const Body& body_;
  std::vector<std::uint32_t> vertex_;  // by node
};

}  // namespace

Surface mesh_surface(const Body& body, const LiveElements& live, std::uint32_t rgba) {
  const MeshBody& mesh = *body.mesh;
  MeshSurfaceMaker maker(body);
  if (mesh.copies() != nullptr)
    for (const LiveElements::Face& face : live.faces())
      maker.take(face.corners, face.origins, face.element, face.is_skin ? rgba : inside_colour(rgba));
  else
    for (const MeshTriangle& face : mesh.faces) maker.take(face, face, 0, rgba);
  if (!mesh.filled.empty()) maker.surface.hidden = (4 * mesh.filled.size() - mesh.faces.size()) / 2;
  return std::move(maker.surface);
}

}  // namespace palpate::physics
