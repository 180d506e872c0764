#include "physics_node/body/body.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/error/error.h"
#include "physics_node/body/build_lattice.h"
#include "physics_node/body/materials.h"

namespace palpate::physics {
namespace {

/// The masses of a body in its own frame, and the box round them.
class OwnFrame {
 public:
  OwnFrame(const BodySpec& spec, const Lattice& lattice) : spec_(spec), lattice_(lattice) {
    lo_ = hi_ = place(lattice.masses.front());
    for (const Index cell : lattice.masses) {
      lo_ = lo_.cwiseMin(place(cell));
      hi_ = hi_.cwiseMax(place(cell));
    }
  }

  /// Is a mass within `depth` of a face that is marked?
  bool is_on(const std::array<bool, 6>& faces, Index cell, const Vec3& depth) const {
    const Vec3 p = place(cell);
    for (int axis = 0; axis < 3; ++axis) {
      if (faces[static_cast<std::size_t>(2 * axis)] && p[axis] <= lo_[axis] + depth[axis]) return true;
      if (faces[static_cast<std::size_t>(2 * axis + 1)] && p[axis] >= hi_[axis] - depth[axis]) return true;
    }
    return false;
  }

 private:
  Vec3 place(Index cell) const {
    return spec_.orientation.transpose() * (lattice_.rest_position(cell) - spec_.at);
  }
  const BodySpec& spec_;
  const Lattice& lattice_;
  Vec3 lo_ = Vec3::Zero(), hi_ = Vec3::Zero();
};

bool is_in_box(const BodySpec& spec, const Vec3& p) {
  return std::any_of(spec.fixed_boxes.begin(), spec.fixed_boxes.end(), [&p](const FixedBox& box) {
    return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
  });
}

void hold_masses(const BodySpec& spec, Body& body) {
  const Lattice& lattice = body.lattice;
  const OwnFrame frame(spec, lattice);
  for (const Index cell : lattice.masses) {
    const bool touches_scenery = body.cells && touches_rigid_cell(*body.cells, lattice, cell);
    if (!touches_scenery && !frame.is_on(spec.fixed_faces, cell, 0.25 * lattice.step) &&
        !is_in_box(spec, lattice.rest_position(cell)))
      continue;
    body.inverse_mass[static_cast<std::size_t>(cell)] = 0;
    ++body.n_held;
  }
}

void give_handle(const BodySpec& spec, Body& body) {
  const Lattice& lattice = body.lattice;
  const OwnFrame frame(spec, lattice);
  const Vec3 spacing =
      lattice.kind == LatticeKind::fcc ? Vec3::Constant(lattice.rest_length[0]) : lattice.step;
  for (const Index cell : lattice.masses)
    if (frame.is_on(spec.handle_faces, cell, 0.75 * spacing)) body.handle.push_back(cell);
  body.tip = spec.at;
}

/// The lattice of an fcc body in an image, and how bright it is at each mass.
void lay_in_image(const BodySpec& spec, Body& body) {
  const Cells image = make_cells(spec);
  body.lattice = fcc_lattice(spec, image);
  body.intensity.assign(static_cast<std::size_t>(body.lattice.n_cells()), 0.0F);
  for (const Index cell : body.lattice.masses) {
    const Vec3i at =
        image.cell_at(body.lattice.rest_position(cell)).cwiseMax(0).cwiseMin(image.size - Vec3i::Ones());
    body.intensity[static_cast<std::size_t>(cell)] = image.intensity[image.index(at.x(), at.y(), at.z())];
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
  } else if (std::holds_alternative<VolumeShape>(spec.shape)) {
    lay_in_image(spec, body);
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
  give_handle(spec, body);
  return body;
}

Body build_body(const BodySpec& spec, const MaterialSpec& material) {
  BodySpec plain = spec;
  plain.material = material.name;
  plain.regions.clear();
  return build_body(plain, std::vector<MaterialSpec>{material});
}

}  // namespace palpate::physics
