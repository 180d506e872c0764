#include "physics_node/body/materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/build_lattice.h"
#include "physics_node/body/solid_shape.h"

namespace palpate::physics {
namespace {

bool holds_mass(const RegionSpec& region, const Vec3& p, double intensity) {
  if (const auto* box = std::get_if<BoxRegion>(&region.where)) return holds(*box, p);
  if (const auto* ball = std::get_if<BallRegion>(&region.where)) return holds(*ball, p);
  const auto& window = std::get<IntensityRegion>(region.where);
  return intensity >= window.lo && intensity <= window.hi;
}

/// 0: the body's own material; r + 1: that of region r. Remembers which regions hold anything.
class RegionMap {
 public:
  RegionMap(const Body& body, const BodySpec& spec)
      : body_(body), regions_(spec.regions), used_(spec.regions.size(), false) {
    if (body.cells) corner_ = lattice_corner(*body.cells, body.lattice);
  }

  std::size_t of_mass(Index cell) {
    if (body_.cells) return of_corner(cell);
    const auto n = static_cast<std::size_t>(cell);
    return of_point(body_.lattice.rest_position(cell),
                    body_.intensity.empty() ? 0.0 : static_cast<double>(body_.intensity[n]));
  }

  /// The first region that holds nothing, or none.
  std::optional<std::size_t> unused() const {
    const auto found = std::find(used_.begin(), used_.end(), false);
    return found == used_.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - used_.begin()));
  }

 private:
  std::size_t of_point(const Vec3& p, double intensity) {
    std::size_t last = 0;
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      if (!holds_mass(regions_[r], p, intensity)) continue;
      used_[r] = true;
      last = r + 1;
    }
    return last;
  }

  std::size_t of_corner(Index cell) {
    const Cells& cells = *body_.cells;
    const Vec3i at = corner_ + body_.lattice.grid_of(cell);
    std::array<std::size_t, 8> found{};
    std::size_t n = 0;
    for (int s = 0; s < 8; ++s) {
      const Vec3i c = at - Vec3i(s & 1, s >> 1 & 1, s >> 2);
      if (!cells.is_deformable(c.x(), c.y(), c.z())) continue;
      const Vec3 centre = cells.corner + cells.spacing.cwiseProduct(c.cast<double>() + Vec3::Constant(0.5));
      const bool has_image = !cells.intensity.empty();
      const double intensity =
          has_image ? static_cast<double>(cells.intensity[cells.index(c.x(), c.y(), c.z())]) : 0.0;
      found[n++] = of_point(centre, intensity);
    }
    std::size_t best = 0;
    std::ptrdiff_t most = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto count = std::count(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n), found[i]);
      if (count < most || (count == most && found[i] < best)) continue;
      most = count;
      best = found[i];
    }
    return best;
  }

  const Body& body_;
  const std::vector<RegionSpec>& regions_;
  std::vector<bool> used_;
  Vec3i corner_ = Vec3i::Zero();
};

const MaterialSpec& named(const std::vector<MaterialSpec>& materials, const std::string& name) {
  const auto found =
      std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == name; });
  PALPATE_CHECK(found != materials.end(), name.c_str());
  return *found;
}

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

  body.inverse_mass.assign(n_cells, 0.0);
  for (const Index cell : body.lattice.masses)
    body.inverse_mass[static_cast<std::size_t>(cell)] = 1.0 / law_at(body, cell).mass;
}

}  // namespace palpate::physics
