#include "physics_node/body/give_solid_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/materials.h"
#include "physics_node/body/region_map.h"

namespace palpate::physics {
namespace {

double beta_of(const MaterialSpec& material) {
  return material.viscosity_bulk.value_or(0.0) / *material.modulus;
}

bool differ(double a, double b) { return std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b)); }

void refuse_mixture(const BodySpec& spec, const RegionSpec& region, const MaterialSpec& own,
                    const MaterialSpec& other) {
  if (differ(own.poisson_ratio, other.poisson_ratio))
    throw InputError(fmt::format(
        "{}: material \"{}\" has poisson_ratio = {}, and \"{}\" of body \"{}\" has {}; finite elements of "
        "one body share it",
        region.place.text(), other.name, other.poisson_ratio, own.name, spec.name, own.poisson_ratio));
  if (own.law != other.law)
    throw InputError(
        fmt::format("{}: material \"{}\" has another law than \"{}\" of body \"{}\"; finite elements "
                    "of one body share it",
                    region.place.text(), other.name, own.name, spec.name));
  const auto same_term = [](const RelaxationSpec& a, const RelaxationSpec& b) {
    return !differ(a.share, b.share) && !differ(a.time, b.time);
  };
  if (!std::ranges::equal(own.relaxation, other.relaxation, same_term))
    throw InputError(
        fmt::format("{}: material \"{}\" relaxes otherwise than \"{}\" of body \"{}\"; finite elements of "
                    "one body share it",
                    region.place.text(), other.name, own.name, spec.name));
  if (differ(beta_of(own), beta_of(other)))
    throw InputError(fmt::format(
        "{}: viscosity over modulus is {:.4g} s in material \"{}\" and {:.4g} s in \"{}\" of body "
        "\"{}\"; finite elements of one body share it",
        region.place.text(), beta_of(other), other.name, beta_of(own), own.name, spec.name));
}

/// Piecewise linear, constant beyond the outermost points [Pa].
double modulus_at(const MaterialSpec& material, double intensity) {
  const std::vector<ModulusPoint>& points = material.modulus_by_intensity;
  if (points.empty()) return *material.modulus;
  if (intensity <= points.front().intensity) return points.front().modulus;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const ModulusPoint &lower = points[n - 1], &upper = points[n];
    if (intensity < upper.intensity)
      return std::lerp(lower.modulus, upper.modulus,
                       (intensity - lower.intensity) / (upper.intensity - lower.intensity));
  }
  return points.back().modulus;
}

Failure failure_of(const MaterialSpec& material) {
  return {.ratio = material.break_ratio.value_or(0.0), .energy = material.fracture_energy.value_or(0.0)};
}

Yielding yielding_of(const MaterialSpec& material) {
  if (!material.yield_ratio) return {};
  return {.ratio = *material.yield_ratio, .hardening = material.k2_ratio};
}

/// Masks that know of cells, since these break as a whole.
void mark_cell(Lattice& lattice, const Vec3i& lowest) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3i at = lowest + Vec3i(corner & 1, corner >> 1 & 1, corner >> 2);
    lattice.mask[static_cast<std::size_t>(lattice.cell_of(at))] |= cell_bit(7 - corner);
  }
}

}  // namespace

void give_solid_elements(Body& body, const BodySpec& spec, const std::vector<MaterialSpec>& materials) {
  const MaterialSpec& own = named(materials, spec.material);
  std::vector<const MaterialSpec*> of_region{&own};
  SolidElements solid;
  solid.modulus = *own.modulus;
  solid.poisson_ratio = own.poisson_ratio;
  solid.beta = beta_of(own);
  solid.density = *own.density;
  solid.hourglass = spec.hourglass;
  solid.law = own.law;
  for (const RelaxationSpec& term : own.relaxation) solid.relaxation.push_back({term.share, term.time});
  for (const RegionSpec& region : spec.regions) {
    of_region.push_back(&named(materials, region.material));
    refuse_mixture(spec, region, own, *of_region.back());
    solid.density = std::min(solid.density, *of_region.back()->density);
  }
  body.lattice.has_cells = std::ranges::any_of(
      of_region, [](const MaterialSpec* material) { return material->break_ratio.has_value(); });
  if (body.lattice.has_cells)
    for (const MaterialSpec* material : of_region) solid.failures.push_back(failure_of(*material));
  const bool yields = std::ranges::any_of(
      of_region, [](const MaterialSpec* material) { return material->yield_ratio.has_value(); });
  if (yields)
    for (const MaterialSpec* material : of_region) solid.yields.push_back(yielding_of(*material));
  const auto n = static_cast<std::size_t>(body.capacity());
  solid.stiffness.assign(n, 0.0F);
  solid.mass.assign(n, 0.0);
  const bool by_material = body.lattice.has_cells || yields || !spec.regions.empty();
  if (by_material) solid.material_of.assign(n, 0);
  solid.largest_stiffness = 0;
  const Cells& cells = *body.cells;
  const Vec3i corner = lattice_corner(cells, body.lattice);
  RegionMap map(body, spec);
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        const auto share = static_cast<double>(cells.share_of(i, j, k));
        if (share == 0) continue;
        const Vec3i at = Vec3i(i, j, k) - corner;
        const auto region = map.of_cell({i, j, k});
        const MaterialSpec& material = *of_region[region];
        if (body.lattice.has_cells) mark_cell(body.lattice, at);
        if (by_material)
          solid.material_of[static_cast<std::size_t>(body.lattice.cell_of(at))] =
              static_cast<std::uint8_t>(region);
        const double intensity =
            cells.intensity.empty() ? 0.0 : static_cast<double>(cells.intensity[cells.index(i, j, k)]);
        const double stiffness = modulus_at(material, intensity) / solid.modulus;
        solid.stiffness[static_cast<std::size_t>(body.lattice.cell_of(at))] =
            static_cast<float>(share * stiffness);
        solid.largest_stiffness =
            std::max(solid.largest_stiffness, stiffness * solid.density / *material.density);
        const double eighth = share * *material.density * body.lattice.step.prod() / 8;
        for (int a = 0; a < 8; ++a)
          solid.mass[static_cast<std::size_t>(body.lattice.cell_of(at + Vec3i(a & 1, a >> 1 & 1, a >> 2)))] +=
              eighth;
      }
  body.solid = std::move(solid);
}

}  // namespace palpate::physics
