#include "physics_node/body/materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/give_solid_elements.h"
#include "physics_node/body/region_map.h"

namespace palpate::physics {
namespace {

/// The names of the materials of a body, its own first, and of each region which of them.
struct MaterialList {
  std::vector<std::string> names;
  std::vector<std::uint8_t> of_region;  // [0] the body's own, [r + 1] of region r
};

MaterialList list_materials(const BodySpec& spec) {
  MaterialList list{{spec.material}, {0}};
  for (const auto& region : spec.regions) {
    const auto found = std::find(list.names.begin(), list.names.end(), region.material);
    list.of_region.push_back(static_cast<std::uint8_t>(found - list.names.begin()));
    if (found == list.names.end()) list.names.push_back(region.material);
  }
  return list;
}

/// All dampers of a body are of one kind (the reader sees to that); a law without one takes the kind of the others.
void share_damper(std::vector<ElementLaw>& laws) {
  const auto damped = std::find_if(laws.begin(), laws.end(), [](const auto& law) { return law.damped; });
  if (damped == laws.end()) return;
  const Damper kind = damped->damper;
  for (auto& law : laws) law.damper = kind;
}

}  // namespace

const MaterialSpec& named(const std::vector<MaterialSpec>& materials, const std::string& name) {
  const auto found =
      std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == name; });
  PALPATE_CHECK(found != materials.end(), name.c_str());
  return *found;
}

void give_materials(Body& body, const BodySpec& spec, const std::vector<MaterialSpec>& materials) {
  const MaterialList list = list_materials(spec);
  const auto n_cells = static_cast<std::size_t>(body.lattice.n_cells());
  std::vector<std::uint8_t> law_of;
  if (!spec.regions.empty()) {
    law_of.assign(n_cells, 0);
    RegionMap map(body, spec);
    for (const Index cell : body.lattice.masses)
      law_of[static_cast<std::size_t>(cell)] = list.of_region[map.of_mass(cell)];
    if (const auto r = map.unused())
      throw InputError(
          fmt::format("{}: region {} of body \"{}\" holds nothing of it; its place must reach the "
                      "deformable tissue where it rests",
                      spec.regions[*r].place.text(), *r + 1, spec.name));
  }

  // Share and number of the masses of each material: with a density they weigh together what they share.
  std::vector<double> share(list.names.size(), 0.0);
  std::vector<double> count(list.names.size(), 0.0);
  for (const Index cell : body.lattice.masses) {
    const auto n = static_cast<std::size_t>(cell);
    const std::size_t m = law_of.empty() ? 0 : law_of[n];
    share[m] += static_cast<double>(body.lattice.mass_share[n]);
    count[m] += 1;
  }
  for (std::size_t m = 0; m < list.names.size(); ++m) {
    const MaterialSpec& material = named(materials, list.names[m]);
    body.laws.push_back(element_law(body.lattice, material));
    if (material.density && count[m] > 0) body.laws[m].mass *= share[m] / count[m];
  }
  share_damper(body.laws);
  body.law = body.laws.front();
  if (body.laws.size() > 1) body.law_of = std::move(law_of);

  if (spec.model == ElementModel::fem) give_solid_elements(body, spec, materials);
  body.inverse_mass.assign(n_cells, 0.0);
  for (const Index cell : body.lattice.masses)
    body.inverse_mass[static_cast<std::size_t>(cell)] = 1.0 / node_mass(body, cell);
}

}  // namespace palpate::physics
