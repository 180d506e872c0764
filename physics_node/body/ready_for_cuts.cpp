// Room for what cuts make of a body.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/body.h"
#include "physics_node/body/build_lattice.h"
#include "physics_node/body/materials.h"
#include "physics_node/body/region_map.h"

namespace palpate::physics {
namespace {

// Why: a cut of 10 cm^2 makes some 350 of a liver of 20,000 tetrahedra, or in cells of 2 mm; small bodies may be cut to pieces.
constexpr std::size_t spare_copies = 4096;
constexpr std::size_t most_copies_of_cells = 65536;

/// @param kind  of elements, as words
template <std::size_t N>
std::unique_ptr<SimplexNet<N>> make_net(const BodySpec& spec, Body& body,
                                        const std::vector<std::array<Index, N>>& elements, const char* kind) {
  MeshBody& mesh = *body.mesh;
  const std::size_t n = mesh.nodes.size(), corners = N * elements.size();
  std::vector<std::size_t> around(n, 0);
  for (const auto& element : elements)
    for (const Index node : element) ++around[static_cast<std::size_t>(node)];
  if (const auto most = std::ranges::max_element(around); *most > SimplexNet<N>::most_around) {
    const Vec3 at = 1e3 * mesh.rest(static_cast<Index>(most - around.begin()));
    throw InputError(fmt::format(
        "{}: body \"{}\" is to be cut, and {} {} meet at a node of its mesh, at {:.4g} {:.4g} {:.4g} "
        "mm; mesh it anew, with at most {}",
        spec.place.text(), spec.name, *most, kind, at.x(), at.y(), at.z(), SimplexNet<N>::most_around));
  }
  const std::size_t copies = std::min(corners - n, n + spare_copies);
  mesh.mass.resize(n + copies, 0.0);
  body.inverse_mass.resize(n + copies, 0.0);
  return std::make_unique<SimplexNet<N>>(elements, n, copies);
}

void give_net_of_mesh(const BodySpec& spec, Body& body) {
  MeshBody& mesh = *body.mesh;
  if (mesh.springs)
    mesh.triangles = make_net<3>(spec, body, mesh.springs->mesh.triangles, "triangles");
  else if (mesh.model.mesh.middles.empty())
    mesh.net = make_net<4>(spec, body, mesh.model.mesh.tets, "tetrahedra");
}

/// What cells weigh and how tough they are, by their own material.
void give_cell_net(const BodySpec& spec, const std::vector<MaterialSpec>& materials, Body& body) {
  SolidElements& solid = *body.solid;
  std::vector<const MaterialSpec*> of_region{&named(materials, spec.material)};
  for (const RegionSpec& region : spec.regions) of_region.push_back(&named(materials, region.material));
  const auto n = static_cast<std::size_t>(body.lattice.n_cells());
  solid.eighth.assign(n, 0.0);
  solid.cut_toughness.assign(n, 0.0F);
  const Cells& cells = *body.cells;
  const Vec3i corner = lattice_corner(cells, body.lattice);
  RegionMap map(body, spec);
  std::size_t n_cells = 0;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        const auto share = static_cast<double>(cells.share_of(i, j, k));
        if (share == 0) continue;
        const MaterialSpec& material = *of_region[map.of_cell({i, j, k})];
        const auto cell = static_cast<std::size_t>(body.lattice.cell_of(Vec3i(i, j, k) - corner));
        solid.eighth[cell] = share * *material.density * body.lattice.step.prod() / 8;
        solid.cut_toughness[cell] = static_cast<float>(material.cut_toughness.value_or(0.0));
        ++n_cells;
      }
  const std::size_t nodes = body.nodes().size();
  const std::size_t copies = std::min({8 * n_cells - nodes, nodes + spare_copies, most_copies_of_cells});
  solid.net = std::make_shared<CellNet>(body.lattice, solid.stiffness, copies);
  solid.mass.resize(n + copies, 0.0);
  body.inverse_mass.resize(n + copies, 0.0);
}

}  // namespace

void make_ready_for_cuts(const BodySpec& spec, const std::vector<MaterialSpec>& materials, Body& body) {
  body.may_be_cut = true;
  if (std::ranges::any_of(body.laws, [](const ElementLaw& law) { return law.cut_toughness <= 0; })) return;
  if (body.mesh) give_net_of_mesh(spec, body);
  if (body.solid && is_parted_where_cut(body)) give_cell_net(spec, materials, body);
}

}  // namespace palpate::physics
