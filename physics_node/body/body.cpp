#include "physics_node/body/body.h"

#include <fmt/format.h>

#include "common/error/error.h"
#include "physics_node/body/build_lattice.h"
#include "physics_node/body/materials.h"

namespace palpate::physics {
namespace {

/// Is a mass at rest position p held, by a face of the shape or by a box?
bool is_held(const BodySpec& spec, const Vec3& p, const Vec3& lo, const Vec3& hi, const Vec3& step) {
  for (int axis = 0; axis < 3; ++axis) {
    const double tolerance = 0.25 * step[axis];
    if (spec.fixed_faces[static_cast<std::size_t>(2 * axis)] && p[axis] <= lo[axis] + tolerance) return true;
    if (spec.fixed_faces[static_cast<std::size_t>(2 * axis + 1)] && p[axis] >= hi[axis] - tolerance)
      return true;
  }
  for (const auto& box : spec.fixed_boxes) {
    if ((p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all()) return true;
  }
  return false;
}

void hold_masses(const BodySpec& spec, Body& body) {
  const Lattice& lattice = body.lattice;
  Vec3 lo = lattice.rest_position(lattice.masses.front());
  Vec3 hi = lo;
  for (const Index cell : lattice.masses) {
    lo = lo.cwiseMin(lattice.rest_position(cell));
    hi = hi.cwiseMax(lattice.rest_position(cell));
  }
  for (const Index cell : lattice.masses) {
    const auto n = static_cast<std::size_t>(cell);
    const Vec3 p = lattice.rest_position(cell);
    const bool touches_scenery = body.cells && touches_rigid_cell(*body.cells, lattice, cell);
    if (!touches_scenery && !is_held(spec, p, lo, hi, lattice.step)) continue;
    body.inverse_mass[n] = 0;
    ++body.n_held;
  }
}

}  // namespace

Body build_body(const BodySpec& spec, const std::vector<MaterialSpec>& materials) {
  Body body;
  body.name = spec.name;
  body.velocity = spec.velocity;
  if (spec.lattice == LatticeKind::voxel) {
    body.cells = make_cells(spec);
    body.lattice = voxel_lattice(*body.cells);
  } else {
    body.lattice = fcc_lattice(spec);
  }
  if (body.lattice.n_masses() < 2) {
    throw InputError(
        fmt::format("{}: body \"{}\" has fewer than two masses; make it larger or spacing_mm smaller",
                    spec.place.text(), spec.name));
  }
  give_materials(body, spec, materials);
  hold_masses(spec, body);
  return body;
}

Body build_body(const BodySpec& spec, const MaterialSpec& material) {
  BodySpec plain = spec;
  plain.material = material.name;
  plain.regions.clear();
  return build_body(plain, std::vector<MaterialSpec>{material});
}

}  // namespace palpate::physics
