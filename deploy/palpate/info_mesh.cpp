#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/scene/body_spec.h"
#include "common/scene/complaints.h"
#include "common/scene/material_spec.h"
#include "deploy/palpate/info.h"
#include "physics_node/body/body.h"
#include "physics_node/mesh/mesh_file.h"
#include "physics_node/mesh/mesh_pinches.h"
#include "physics_node/mesh/mesh_quality.h"
#include "physics_node/step/lattice/stable_step.h"

namespace palpate::deploy {
namespace {

constexpr double modulus = 10e3, poisson_ratio = 0.45, density = 1000;  // of soft tissue [Pa, 1, kg/m^3]

/// Of a body of soft tissue that is this mesh [s].
double step_of(const std::string& path) {
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.modulus = modulus;
  tissue.poisson_ratio = poisson_ratio;
  tissue.density = density;
  BodySpec spec;
  spec.name = "mesh";
  spec.model = ElementModel::fem;
  spec.material = tissue.name;
  spec.shape = MeshShape{path, 1};
  return physics::stable_step(physics::stiffest_mode(physics::build_body(spec, tissue)),
                              Integrator::symplectic_euler);
}

}  // namespace

std::string info_mesh(const std::string& path) {
  const physics::MeshFile file = physics::read_mesh(path);
  const physics::TetMesh& mesh = file.mesh;
  const Eigen::AlignedBox3d box = box_of(mesh);
  const std::size_t pieces = n_pieces_of(mesh);
  const physics::OuterFaces faces = outer_faces(mesh);
  const physics::Pinches pinches = pinches_of(mesh, faces);
  const physics::DihedralAngles angles = dihedral_angles(mesh);
  const std::set<int> regions(mesh.region.begin(), mesh.region.end());
  const Vec3 size = box.sizes(), low = box.min();
  std::string text = fmt::format("mesh         {}\n", path);
  text += fmt::format("tetrahedra   {}, with {} nodes, in {} piece{} and {} region{}\n", mesh.tets.size(),
                      mesh.nodes.size(), pieces, pieces == 1 ? "" : "s", regions.size(),
                      regions.size() == 1 ? "" : "s");
  text += fmt::format("extent       {:.6g} x {:.6g} x {:.6g} mm, from ({:.6g}, {:.6g}, {:.6g}) mm\n",
                      mm_from_m(size.x()), mm_from_m(size.y()), mm_from_m(size.z()), mm_from_m(low.x()),
                      mm_from_m(low.y()), mm_from_m(low.z()));
  text += fmt::format("volume       {:.6g} cm^3\n", 1e6 * volume_of(mesh));
  text += fmt::format("surface      {} triangles", faces.triangles.size());
  if (faces.of_more > 0) text += fmt::format("; {} faces are of more than two tetrahedra", faces.of_more);
  text += pinches.none()
              ? ", each edge of two of them\n"
              : fmt::format(
                    "; it touches itself at {} edges and {} nodes, first at ({:.6g}, {:.6g}, {:.6g}) mm\n",
                    pinches.edges, pinches.nodes, mm_from_m(pinches.where.x()), mm_from_m(pinches.where.y()),
                    mm_from_m(pinches.where.z()));
  text += fmt::format("quality      dihedral angles {:.3g} to {:.3g} degrees, smallest altitude {:.3g} mm\n",
                      deg_from_rad(angles.least), deg_from_rad(angles.largest),
                      mm_from_m(smallest_altitude(mesh)));
  if (faces.of_more == 0 && !faces.triangles.empty())
    text += fmt::format("step         {:.3g} ms at {:g} kPa, Poisson's ratio {:g}, {:g} kg/m^3\n",
                        1e3 * step_of(path), 1e-3 * modulus, poisson_ratio, density);
  return text + fmt::format("source       {}\n", one_line(file.source));
}

}  // namespace palpate::deploy
