#include "physics_node/lattice/surroundings.h"

namespace palpate::physics {
namespace {

Vec3i point_of(const Lattice& lattice, int row_kind) {
  const int parity = row_kind % 2;
  return lattice.kind == LatticeKind::fcc ? Vec3i(4 + parity, 4 + parity, 4)
                                          : Vec3i(4 + row_kind / 2, 4, 4 + parity);
}

}  // namespace

Surroundings::Surroundings(const Lattice& lattice, int row_kind)
    : lattice_(lattice), at_(point_of(lattice, row_kind)), half_(half_directions(lattice.kind)) {}

std::optional<int> Surroundings::element(const Vec3i& from, const Vec3i& to) const {
  const Vec3i delta = to - from;
  const auto n = static_cast<int>(half_.size());
  for (int d = 0; d < 2 * n; ++d) {
    const Vec3i& half = half_[static_cast<std::size_t>(d % n)];
    if (delta != (d < n ? half : Vec3i(-half))) continue;
    // Diagonals of voxels join points of even X + Y + Z.
    const bool exists =
        lattice_.kind == LatticeKind::fcc || delta.cwiseAbs().sum() == 1 || ((at_ + from).sum() & 1) == 0;
    return exists ? std::optional(d) : std::nullopt;
  }
  return std::nullopt;
}

std::vector<Vec3i> Surroundings::neighbours(const Vec3i& of) const {
  std::vector<Vec3i> found;
  for (const Vec3i& half : half_)
    for (const Vec3i& delta : {half, Vec3i(-half)})
      if (element(of, of + delta)) found.push_back(of + delta);
  return found;
}

std::vector<Need> Surroundings::needs(const std::vector<Vec3i>& points) const {
  std::vector<Need> list;
  for (std::size_t p = 0; p < points.size(); ++p) {
    Need need{offset(points[p]), 0};
    for (std::size_t q = p + 1; q < points.size(); ++q) {
      if (const auto d = element(points[p], points[q])) need.bits |= 1U << *d;
    }
    if (need.bits != 0) list.push_back(need);
  }
  return list;
}

std::vector<Need> Surroundings::needs_of_volume(const std::vector<Vec3i>& points) const {
  std::vector<Need> list = needs(points);
  if (!lattice_.has_cells) return list;
  Vec3i lowest = points.front();
  for (const Vec3i& point : points) lowest = lowest.cwiseMin(point);
  unsigned octant = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (points.front()[axis] == lowest[axis]) octant |= 1U << axis;
  list.front().bits |= cell_bit(octant);  // the first corner is joined to all others
  return list;
}

}  // namespace palpate::physics
