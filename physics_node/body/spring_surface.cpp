#include "physics_node/body/spring_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace palpate::physics {
namespace {

Vec3 place(const TriangleMesh& mesh, Index node) { return mesh.nodes[static_cast<std::size_t>(node)]; }

}  // namespace

SpringSurface spring_surface(TriangleMesh mesh, const Membrane& membrane) {
  SpringSurface surface;
  surface.mesh = std::move(mesh);
  std::ranges::sort(surface.mesh.triangles);
  surface.membrane = membrane;
  surface.volume = enclosed_volume(surface.mesh);
  surface.mass.resize(surface.mesh.nodes.size());
  std::vector<double> area;
  for (const MeshTriangle& corners : surface.mesh.triangles) {
    area.push_back(area_of(surface.mesh, corners));
    for (const Index node : corners)
      surface.mass[static_cast<std::size_t>(node)] += mass_share(membrane, area.back());
  }
  for (const MeshEdge& edge : edges_of(surface.mesh)) {
    SurfaceSpring spring{.node = edge.node};
    spring.length = (place(surface.mesh, edge.node[1]) - place(surface.mesh, edge.node[0])).norm();
    for (const Index t : edge.triangle)
      spring.k += spring_share(membrane, area[static_cast<std::size_t>(t)], spring.length);
    surface.springs.push_back(spring);
  }
  return surface;
}

}  // namespace palpate::physics
