#include "physics_node/body/build_lattice.h"

#include <cmath>
#include <numbers>

namespace palpate::physics {
namespace {

struct CellBox {
  Vec3i lo, hi;
};

CellBox deformable_box(const Cells& cells) {
  CellBox box{cells.size, Vec3i::Constant(-1)};
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        if (cells.deformable[cells.index(i, j, k)] == 0) continue;
        box.lo = box.lo.cwiseMin(Vec3i(i, j, k));
        box.hi = box.hi.cwiseMax(Vec3i(i, j, k));
      }
  return box;
}

/// Sets the bits of every element whose two ends are masses and for which `holds(grid, direction)` says yes.
template <class Holds>
void join_elements(Lattice& lattice, const Holds& holds) {
  const auto directions = half_directions(lattice.kind);
  for (const Index cell : lattice.masses) {
    const Vec3i grid = lattice.grid_of(cell);
    const auto kind = static_cast<std::size_t>(lattice.row_kind(cell));
    for (std::size_t d = 0; d < directions.size(); ++d) {
      const auto other = static_cast<std::size_t>(cell + lattice.offset[kind][d]);
      if (lattice.mass_share[other] <= 0 || !holds(grid, d)) continue;
      auto& mine = lattice.mask[static_cast<std::size_t>(cell)];
      auto& theirs = lattice.mask[other];
      mine = static_cast<Mask>(mine | (1U << d));
      theirs = static_cast<Mask>(theirs | (1U << (d + directions.size())));
    }
  }
}

bool inside(const BodySpec& body, const Vec3& p) {
  constexpr double slack = 1e-9;  // [m], so that a point meant to lie on the surface is inside
  if (const auto* sphere = std::get_if<SphereShape>(&body.shape)) return p.norm() <= sphere->radius + slack;
  if (const auto* tube = std::get_if<TubeShape>(&body.shape)) {
    const double along = p[tube->axis];
    const double across = std::sqrt(std::max(0.0, p.squaredNorm() - along * along));
    return std::abs(along) <= 0.5 * tube->length + slack && across <= tube->outer_radius + slack &&
           across >= tube->inner_radius - slack;
  }
  const auto& box = std::get<BoxShape>(body.shape);
  return (p.array().abs() <= 0.5 * box.size.array() + slack).all();
}

Vec3 half_extent(const BodySpec& body) {
  if (const auto* sphere = std::get_if<SphereShape>(&body.shape)) return Vec3::Constant(sphere->radius);
  if (const auto* tube = std::get_if<TubeShape>(&body.shape)) {
    Vec3 half = Vec3::Constant(tube->outer_radius);
    half[tube->axis] = 0.5 * tube->length;
    return half;
  }
  return 0.5 * std::get<BoxShape>(body.shape).size;
}

}  // namespace

Lattice voxel_lattice(const Cells& cells) {
  const CellBox box = deformable_box(cells);
  const Vec3 origin = cells.corner + cells.spacing.cwiseProduct(box.lo.cast<double>());
  Lattice lattice =
      make_lattice(LatticeKind::voxel, box.hi - box.lo + Vec3i::Constant(2), origin, cells.spacing);
  for (int k = box.lo.z(); k <= box.hi.z(); ++k)
    for (int j = box.lo.y(); j <= box.hi.y(); ++j)
      for (int i = box.lo.x(); i <= box.hi.x(); ++i) {
        if (cells.deformable[cells.index(i, j, k)] == 0) continue;
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3i at = Vec3i(i, j, k) - box.lo + Vec3i(corner & 1, corner >> 1 & 1, corner >> 2);
          lattice.mass_share[static_cast<std::size_t>(lattice.cell_of(at))] += 0.125F;
        }
      }
  index_masses(lattice);

  // An edge in direction d from grid point g lies in the cells g + min(d, 0) - s, where s runs over the axes that d
  // leaves out. Diagonals join even points.
  const auto directions = half_directions(LatticeKind::voxel);
  join_elements(lattice, [&](const Vec3i& grid, std::size_t d) {
    const Vec3i along = directions[d];
    if (along.cwiseAbs().sum() == 2 && (grid.sum() & 1) != 0) return false;
    for (int s = 0; s < 8; ++s) {
      const Vec3i back(s & 1, s >> 1 & 1, s >> 2);
      if (back.cwiseProduct(along) != Vec3i::Zero()) continue;
      const Vec3i at = grid + box.lo + along.cwiseMin(0) - back;
      if (cells.is_deformable(at.x(), at.y(), at.z())) return true;
    }
    return false;
  });
  return lattice;
}

Lattice fcc_lattice(const BodySpec& body) {
  const double step = *body.spacing / std::numbers::sqrt2;
  const Vec3 half = half_extent(body);
  const bool is_box = std::holds_alternative<BoxShape>(body.shape);
  // Grid coordinate (0, 0, 0) is the lowest corner of a box; elsewhere an even number of steps below the centre.
  const Vec3i below = is_box ? Vec3i::Zero() : Vec3i(2 * (half / (2 * step)).array().ceil().cast<int>());
  const Vec3i extent =
      is_box ? Vec3i((2 * half / step).array().floor().cast<int>() + 2) : Vec3i(2 * below.array() + 1);
  const Vec3 origin = is_box ? Vec3(body.at - half) : Vec3(body.at - step * below.cast<double>());

  Lattice lattice = make_lattice(LatticeKind::fcc, extent, origin, Vec3::Constant(step));
  for (int z = 0; z < extent.z(); ++z)
    for (int y = 0; y < extent.y(); ++y)
      for (int x = (y + z) & 1; x < extent.x(); x += 2) {
        const Vec3 p = origin + step * Vec3(x, y, z) - body.at;
        if (inside(body, p)) lattice.mass_share[static_cast<std::size_t>(lattice.cell_of({x, y, z}))] = 1.0F;
      }
  index_masses(lattice);
  join_elements(lattice, [](const Vec3i&, std::size_t) { return true; });
  return lattice;
}

Vec3i lattice_corner(const Cells& cells, const Lattice& lattice) {
  return ((lattice.origin - cells.corner).array() / cells.spacing.array()).round().cast<int>();
}

bool touches_rigid_cell(const Cells& cells, const Lattice& lattice, Index cell) {
  const Vec3i at = lattice_corner(cells, lattice) + lattice.grid_of(cell);
  for (int s = 0; s < 8; ++s) {
    const int i = at.x() - (s & 1);
    const int j = at.y() - (s >> 1 & 1);
    const int k = at.z() - (s >> 2);
    if (cells.is_filled(i, j, k) && !cells.is_deformable(i, j, k)) return true;
  }
  return false;
}

}  // namespace palpate::physics
