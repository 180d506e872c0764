#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "common/math/units.h"
#include "common/scene/complaints.h"
#include "deploy/palpate/info.h"
#include "physics_node/body/spring_surface.h"
#include "physics_node/mesh/surface_file.h"
#include "physics_node/step/lattice/stable_step.h"
#include "physics_node/step/surface_mesh/surface_springs.h"

namespace palpate::deploy {
namespace {

constexpr physics::Membrane thin_wall{.modulus = 100e3, .thickness = 1e-3, .density = 1000};

/// Of a membrane like that [s].
double step_of_wall(const physics::TriangleMesh& mesh) {
  const physics::SpringSurface springs = physics::spring_surface(mesh, thin_wall);
  std::vector<double> inverse_mass;
  for (const double mass : springs.mass) inverse_mass.push_back(1 / mass);
  physics::SurfaceSprings<double> moving(springs, inverse_mass);
  return physics::stable_step({moving.omega2(), 0}, Integrator::symplectic_euler);
}

}  // namespace

std::string info_surface(const std::string& path) {
  const physics::SurfaceFile file = physics::read_surface_file(path);
  const physics::TriangleMesh& mesh = file.mesh;
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.nodes) box.extend(x);
  const Vec3 size = box.sizes(), low = box.min();
  const double area = std::accumulate(
      mesh.triangles.begin(), mesh.triangles.end(), 0.0,
      [&](double sum, const physics::MeshTriangle& corners) { return sum + area_of(mesh, corners); });
  double shortest = box.sizes().norm(), longest = 0;
  for (const physics::MeshEdge& edge : edges_of(mesh)) {
    const double length = (mesh.nodes[static_cast<std::size_t>(edge.node[1])] -
                           mesh.nodes[static_cast<std::size_t>(edge.node[0])])
                              .norm();
    shortest = std::min(shortest, length), longest = std::max(longest, length);
  }
  std::string text = fmt::format("surface      {}\n", path);
  text += fmt::format("triangles    {}, with {} nodes, edges of {:.3g} to {:.3g} mm\n", mesh.triangles.size(),
                      mesh.nodes.size(), mm_from_m(shortest), mm_from_m(longest));
  text += fmt::format("extent       {:.6g} x {:.6g} x {:.6g} mm, from ({:.6g}, {:.6g}, {:.6g}) mm\n",
                      mm_from_m(size.x()), mm_from_m(size.y()), mm_from_m(size.z()), mm_from_m(low.x()),
                      mm_from_m(low.y()), mm_from_m(low.z()));
  text +=
      fmt::format("area         {:.6g} cm^2, around {:.6g} cm^3\n", 1e4 * area, 1e6 * enclosed_volume(mesh));
  text += fmt::format("step         {:.3g} ms at {:g} kPa, {:g} mm thick, {:g} kg/m^3\n",
                      1e3 * step_of_wall(mesh), 1e-3 * thin_wall.modulus, mm_from_m(thin_wall.thickness),
                      thin_wall.density);
  return text + fmt::format("source       {}\n", one_line(file.source));
}

}  // namespace palpate::deploy
