#include "physics_node/body/build_mesh_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/materials.h"
#include "physics_node/body/mesh_body.h"
#include "physics_node/body/put_in_place.h"
#include "physics_node/body/solid_shape.h"
#include "physics_node/mesh/mesh_file.h"
#include "physics_node/mesh/read_msh.h"
#include "physics_node/mesh/renumber.h"
#include "physics_node/mesh/surface_file.h"

namespace palpate::physics {
namespace {

double beta_of(const MaterialSpec& material) {
  return material.viscosity_bulk.value_or(0.0) / *material.modulus;
}

/// Materials of a body, its own first, each once.
class MaterialTable {
 public:
  MaterialTable(const BodySpec& spec, const std::vector<MaterialSpec>& materials) {
    of_region_.push_back(number(named(materials, spec.material)));
    for (const RegionSpec& region : spec.regions) {
      const MaterialSpec& material = named(materials, region.material);
      refuse_other_beta(spec, region, *list_.front(), material);
      of_region_.push_back(number(material));
    }
  }
  const std::vector<const MaterialSpec*>& list() const { return list_; }
  /// 0: the body's own; r + 1: of region r.
  int of_region(std::size_t region) const { return of_region_[region]; }

 private:
  int number(const MaterialSpec& material) {
    const auto found = std::ranges::find(list_, &material);
    const auto n = static_cast<int>(found - list_.begin());
    if (found == list_.end()) list_.push_back(&material);
    return n;
  }
  static void refuse_other_beta(const BodySpec& spec, const RegionSpec& region, const MaterialSpec& own,
                                const MaterialSpec& other) {
    const double a = beta_of(own), b = beta_of(other);
    if (std::abs(a - b) <= 1e-9 * std::max(a, b)) return;
    throw InputError(fmt::format(
        "{}: viscosity over modulus is {:.4g} s in material \"{}\" and {:.4g} s in \"{}\" of body \"{}\"; "
        "finite elements of one body share it",
        region.place.text(), b, other.name, a, own.name, spec.name));
  }

  std::vector<const MaterialSpec*> list_;
  std::vector<int> of_region_;
};

bool holds_tet(const RegionSpec& region, const Vec3& centre, int group) {
  if (const auto* box = std::get_if<BoxRegion>(&region.where)) return holds(*box, centre);
  if (const auto* ball = std::get_if<BallRegion>(&region.where)) return holds(*ball, centre);
  const auto* of_group = std::get_if<GroupRegion>(&region.where);
  return of_group != nullptr && of_group->group == group;
}

/// Makes of the file's groups numbers of materials.
void give_regions(TetMesh& mesh, const BodySpec& spec, const MaterialTable& table) {
  std::vector<bool> used(spec.regions.size(), false);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const Index node : mesh.tets[t]) centre += mesh.nodes[static_cast<std::size_t>(node)] / 4;
    std::size_t last = 0;
    for (std::size_t r = 0; r < spec.regions.size(); ++r)
      if (holds_tet(spec.regions[r], centre, mesh.region[t])) used[r] = true, last = r + 1;
    mesh.region[t] = table.of_region(last);
  }
  for (std::size_t r = 0; r < used.size(); ++r)
    if (!used[r])
      throw InputError(fmt::format(
          "{}: region {} of body \"{}\" holds no tetrahedron of it; its place must reach a centre of "
          "one where the body rests, or its group be one of the file's",
          spec.regions[r].place.text(), r + 1, spec.name));
}

}  // namespace

void build_mesh_body(Body& body, const BodySpec& spec, const std::vector<MaterialSpec>& materials) {
  const auto& shape = std::get<MeshShape>(spec.shape);
  const MaterialTable table(spec, materials);
  MshContent content;
  if (is_surface_file(shape.file))
    throw InputError(
        fmt::format("{}: {} is a surface; write model = \"surface\", or fill it by palpate import with "
                    "--tetrahedra-mm",
                    spec.place.text(), shape.file));
  if (is_mesh_file_name(shape.file))
    content.mesh = read_mesh(shape.file).mesh;
  else
    content = read_msh(shape.file, shape.metres);
  const OuterFaces outer = outer_faces(content.mesh);
  if (outer.triangles.empty())
    throw InputError(fmt::format(
        "{}: no face in {} is of one tetrahedron, so the body has no surface; mesh it anew, each place once",
        spec.place.text(), shape.file));
  if (const std::size_t of_more = outer.of_more; of_more > 0)
    throw InputError(
        fmt::format("{}: {} faces in {} are of more than two tetrahedra, so the mesh goes through itself; "
                    "mesh it anew, each "
                    "place once",
                    spec.place.text(), of_more, shape.file));
  TetModel model;
  model.mesh = std::move(content.mesh);
  put_in_place(model.mesh.nodes, spec);
  give_regions(model.mesh, spec, table);
  if (spec.tet_elements == TetElements::second_order) add_middles(model.mesh);
  renumber(model.mesh);
  model.beta = beta_of(*table.list().front());
  for (const MaterialSpec* material : table.list()) {
    model.materials.push_back({.modulus = *material->modulus,
                               .poisson_ratio = material->poisson_ratio,
                               .density = *material->density,
                               .nodal_pressure = spec.tet_elements == TetElements::nodal_pressure});
    ElementLaw& law = body.laws.emplace_back();
    law.modulus = *material->modulus;
    law.cut_toughness = material->cut_toughness.value_or(0.0);
    law.puncture_ratio = material->puncture_ratio;
    law.damped = model.beta > 0;
    // Why: it resists the rate of strain alone, and so both momenta stay, as along elements.
    law.damper = Damper::axial;
  }
  body.law = body.laws.front();
  MeshBody mesh = mesh_body(std::move(model));
  mesh.tidied = content.tidied;
  for (const double mass : mesh.mass) body.inverse_mass.push_back(1 / mass);
  body.mesh = std::make_shared<MeshBody>(std::move(mesh));
}

}  // namespace palpate::physics
