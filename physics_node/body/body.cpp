#include "physics_node/body/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/build_lattice.h"
#include "physics_node/body/build_mesh_body.h"
#include "physics_node/body/build_surface_body.h"
#include "physics_node/body/materials.h"

namespace palpate::physics {
namespace {

/// The masses of a body in its own frame, and the box round them.
class OwnFrame {
 public:
  OwnFrame(const BodySpec& spec, const Body& body) : spec_(spec), body_(body) {
    lo_ = hi_ = place(body.nodes().front());
    for (const Index cell : body.nodes()) {
      lo_ = lo_.cwiseMin(place(cell));
      hi_ = hi_.cwiseMax(place(cell));
    }
  }

  /// How deep below each face; nothing: not at all.
  using Depths = std::array<std::optional<double>, 6>;  // [m]

  /// Is a mass within that depth of a face?
  bool is_on(const Depths& depth, Index cell) const {
    const Vec3 p = place(cell);
    for (std::size_t f = 0; f < 6; ++f)
      if (depth[f] && below(f, p) <= *depth[f]) return true;
    return false;
  }

  /// Are the masses in the outermost layer of a face a single row: longer than an element, and less than one wide?
  bool is_row(std::size_t face, double layer) const {
    const auto [narrow, wide] = extent(face, layer);
    const double element = 0.99 * body_.spacing();
    return wide > element && narrow < element;
  }
  /// Are they a row or fewer?
  bool is_narrow(std::size_t face, double layer) const {
    return extent(face, layer).first < 0.5 * body_.spacing();  // Why: a single triangle is wider
  }

 private:
  /// Of the outermost layer of a face, along its own axes [m].
  std::pair<double, double> extent(std::size_t face, double layer) const {
    Eigen::AlignedBox3d box;
    for (const Index cell : body_.nodes())
      if (below(face, place(cell)) <= layer) box.extend(place(cell));
    const Vec3 size = box.sizes();
    const auto axis = static_cast<Eigen::Index>(face / 2);
    return std::minmax({size[(axis + 1) % 3], size[(axis + 2) % 3]});
  }
  double below(std::size_t face, const Vec3& p) const {
    const auto axis = static_cast<Eigen::Index>(face / 2);
    return face % 2 == 0 ? p[axis] - lo_[axis] : hi_[axis] - p[axis];
  }
  Vec3 place(Index cell) const {
    return spec_.orientation.transpose() * (body_.rest_position(cell) - spec_.at);
  }
  const BodySpec& spec_;
  const Body& body_;
  Vec3 lo_ = Vec3::Zero(), hi_ = Vec3::Zero();
};

bool is_in_box(const BodySpec& spec, const Vec3& p) {
  return std::any_of(spec.fixed_boxes.begin(), spec.fixed_boxes.end(), [&p](const FixedBox& box) {
    return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
  });
}

/// On fcc the two outermost layers, of voxels one: the masses of a cell are two rows already [m].
double two_layers(const Lattice& lattice, std::size_t face) {
  const bool fcc = lattice.kind == LatticeKind::fcc;
  return 0.75 * (fcc ? lattice.rest_length[0] : lattice.step[static_cast<Eigen::Index>(face / 2)]);
}

/// What counts as the outermost layer of masses of a face [m].
double outermost(const Body& body, std::size_t face) {
  return 0.25 * (body.mesh ? body.spacing() : body.lattice.step[static_cast<Eigen::Index>(face / 2)]);
}

/// A face of a mesh that is round has few nodes in its outermost layer, and they would be a hinge.
[[noreturn]] void refuse_hinge(const BodySpec& spec, std::size_t face) {
  constexpr std::array<const char*, 6> names = {"-x", "+x", "-y", "+y", "-z", "+z"};
  throw InputError(
      fmt::format("{}: fixed = [\"{}\"] of body \"{}\" would hold a point or a line of its mesh, and it "
                  "could swing about that; "
                  "give a box {{ min_mm = [x, y, z], max_mm = [x, y, z] }} of what is held",
                  spec.place.text(), names[face], spec.name));
}

void hold_masses(const BodySpec& spec, Body& body) {
  const OwnFrame frame(spec, body);
  OwnFrame::Depths depth;
  for (std::size_t f = 0; f < 6; ++f) {
    if (!spec.fixed_faces[f]) continue;
    const double layer = outermost(body, f);
    if (body.mesh && frame.is_narrow(f, layer)) refuse_hinge(spec, f);
    // A row of masses is a hinge: there two layers are held, as for a handle.
    depth[f] = !body.mesh && frame.is_row(f, layer) ? two_layers(body.lattice, f) : layer;
  }
  for (const Index cell : body.nodes()) {
    const bool touches_scenery = body.cells && touches_rigid_cell(*body.cells, body.lattice, cell);
    if (!touches_scenery && !frame.is_on(depth, cell) && !is_in_box(spec, body.rest_position(cell))) continue;
    body.inverse_mass[static_cast<std::size_t>(cell)] = 0;
    ++body.n_held;
  }
  if (!body.mesh || body.n_held == 0) return;
  for (const double w : body.inverse_mass) body.mesh->model.held.push_back(w == 0);
}

void give_handle(const BodySpec& spec, Body& body) {
  const OwnFrame frame(spec, body);
  OwnFrame::Depths depth;
  for (std::size_t f = 0; f < 6; ++f)
    if (spec.handle_faces[f]) depth[f] = two_layers(body.lattice, f);
  for (const Index cell : body.nodes())
    if (frame.is_on(depth, cell)) body.handle.push_back(cell);
  body.tip = spec.at;
}

/// Of a body that is awake in parts [m].
std::optional<double> awake_radius_of(const BodySpec& spec) {
  const auto* image = std::get_if<VolumeShape>(&spec.shape);
  return image != nullptr ? image->deformable.awake : std::nullopt;
}

/// What is awake is held by the rest: there must be enough of it. Why half the second of three extents: a rim is then on all sides of a
/// place but one, in a plate too.
void refuse_loose(const BodySpec& spec, const Body& body) {
  if (!is_awake_in_parts(body) || body.n_held > 0) return;
  Eigen::AlignedBox3d box;
  for (const Index node : body.nodes()) box.extend(body.rest_position(node));
  Vec3 extent = box.sizes();
  std::sort(extent.begin(), extent.end());
  const double awake = 2 * (body.solid->awake_radius + 3 * body.spacing());
  if (awake <= 0.5 * extent[1]) return;
  throw InputError(
      fmt::format("{}: awake_mm = {:.4g} leaves too little of body \"{}\", of {:.3g} x {:.3g} x {:.3g} mm, "
                  "to hold what is "
                  "awake; give fixed = [\"-z\"] or a box, or at most awake_mm = {:.3g}",
                  spec.place.text(), 1e3 * body.solid->awake_radius, spec.name, 1e3 * box.sizes().x(),
                  1e3 * box.sizes().y(), 1e3 * box.sizes().z(),
                  std::max(0.0, 1e3 * (0.25 * extent[1] - 3 * body.spacing()))));
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

double stepped_masses(const Body& body) noexcept {
  const auto all = static_cast<double>(body.n_nodes());
  if (!is_awake_in_parts(body)) return all;
  // Half a ball, in rows along x that wake in segments of two vectors' length: they reach half a segment further at both ends.
  const double R = body.solid->awake_radius;
  const Vec3& h = body.lattice.step;
  const double rows = std::numbers::pi * R * R / (h.y() * h.z());
  return std::min(all, 0.5 * rows * (4.0 / 3 * R / h.x() + 2 * row_segment));
}

Body build_body(const BodySpec& spec, const std::vector<MaterialSpec>& materials) {
  Body body;
  body.name = spec.name;
  body.velocity = spec.velocity;
  if (std::holds_alternative<MeshShape>(spec.shape)) {
    if (spec.model == ElementModel::surface)
      build_surface_body(body, spec, materials);
    else
      build_mesh_body(body, spec, materials);
    hold_masses(spec, body);
    body.tip = spec.at;
    return body;
  }
  if (spec.lattice == LatticeKind::voxel) {
    body.cells = make_cells(spec);
    body.lattice = voxel_lattice(*body.cells);
    if (awake_radius_of(spec)) index_masses(body.lattice, Rows::in_segments);
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
  if (body.solid) body.solid->awake_radius = awake_radius_of(spec).value_or(0.0);
  hold_masses(spec, body);
  give_handle(spec, body);
  refuse_loose(spec, body);
  return body;
}

Body build_body(const BodySpec& spec, const MaterialSpec& material) {
  BodySpec plain = spec;
  plain.material = material.name;
  plain.regions.clear();
  return build_body(plain, std::vector<MaterialSpec>{material});
}

}  // namespace palpate::physics
