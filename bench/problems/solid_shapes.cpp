#include "bench/problems/solid_shapes.h"

#include <algorithm>
#include <cmath>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"

namespace palpate::bench {
namespace {

bool in_blob(const Vec3& x) {
  const auto in = [&](const Vec3& centre, const Vec3& radii) {
    return (x - centre).cwiseQuotient(radii).norm() < 1;
  };
  return in({0.35, 0.5, 0.35}, {0.33, 0.4, 0.4}) || in({0.65, 0.45, 0.25}, {0.34, 0.3, 0.2}) ||
         in({0.8, 0.6, 0.15}, {0.18, 0.15, 0.15});
}

/// Modulus of a cell over the body's own; 0: it is not there.
double stiffness_of(const SolidKind& kind, const physics::Vec3i& at) {
  const int n = kind.cells;
  const Vec3 x = (at.cast<double>() + Vec3::Constant(0.5)) / n;
  const double radius = std::hypot(x.x() - 0.5, x.y() - 0.5);
  switch (kind.shape) {
    case SolidShape::cube:
    case SolidShape::image:
      return 1;
    case SolidShape::lump:
      return (x - Vec3::Constant(0.5)).norm() < 0.22 ? 100 : 1;
    case SolidShape::blob:
      return in_blob(x) ? 1 : 0;
    case SolidShape::tube:
      return radius < 0.5 && radius > 0.3 && at.z() < n - 1 ? 1 : 0;
    case SolidShape::slit:
      return at.x() == n / 2 && at.z() >= n / 4 ? 0 : 1;
  }
  return 1;
}

}  // namespace

physics::Body make_solid(const SolidKind& kind) {
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.modulus = kind.modulus;
  tissue.poisson_ratio = kind.poisson_ratio;
  tissue.density = 1000;
  BodySpec spec;
  spec.name = solid_shape_names[static_cast<int>(kind.shape)];
  spec.lattice = LatticeKind::voxel;
  spec.model = ElementModel::fem;
  if (!kind.image) spec.spacing = kind.edge;
  spec.material = "tissue";
  const double side = kind.edge * kind.cells;
  if (kind.image)
    spec.shape = *kind.image;
  else
    spec.shape = BoxShape{Vec3::Constant(side)};
  spec.fixed_faces[4] = true;  // -z
  if (kind.shape == SolidShape::tube)
    spec.fixed_boxes.push_back({{-side, -side, 0.5 * side - 1.1 * kind.edge}, {side, side, side}});
  physics::Body body = physics::build_body(spec, tissue);
  if (kind.shape == SolidShape::cube || kind.image) return body;
  physics::Vec3i lowest = body.lattice.size;
  for (const physics::Index node : body.nodes()) lowest = lowest.cwiseMin(body.lattice.grid_of(node));
  std::fill(body.solid->mass.begin(), body.solid->mass.end(), 0.0);
  for (const physics::Index node : body.nodes()) {
    float& own = body.solid->stiffness[static_cast<std::size_t>(node)];
    if (own <= 0) continue;
    const physics::Vec3i at = body.lattice.grid_of(node);
    own = static_cast<float>(stiffness_of(kind, at - lowest));
    body.solid->largest_stiffness = std::max(body.solid->largest_stiffness, static_cast<double>(own));
    for (int a = 0; a < 8 && own > 0; ++a)
      body.solid->mass[static_cast<std::size_t>(
          body.lattice.cell_of(at + physics::Vec3i(a & 1, a >> 1 & 1, a >> 2)))] +=
          body.solid->density * body.lattice.step.prod() / 8;
  }
  // What is left of a node's mass; nodes without cells stay where they are.
  for (const physics::Index node : body.nodes()) {
    double& inverse = body.inverse_mass[static_cast<std::size_t>(node)];
    const double mass = body.solid->mass[static_cast<std::size_t>(node)];
    if (inverse > 0) inverse = mass > 0 ? 1 / mass : 0;
  }
  return body;
}

physics::Index n_cells_of(const physics::Body& body) {
  physics::Index n = 0;
  for (const physics::Index node : body.nodes())
    n += body.solid->stiffness[static_cast<std::size_t>(node)] > 0 ? 1 : 0;
  return n;
}

}  // namespace palpate::bench
