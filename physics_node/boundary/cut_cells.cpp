#include "physics_node/boundary/cut_cells.h"

#include "physics_node/body/build_lattice.h"

namespace palpate::physics {
namespace {

Vec3i corner_of(unsigned bits) {
  return {static_cast<int>(bits & 1), static_cast<int>(bits >> 1 & 1), static_cast<int>(bits >> 2 & 1)};
}

}  // namespace

CellsNow::CellsNow(const Body& body, std::span<const Mask> masks)
    : cells_(*body.cells),
      net_(body.lattice, masks),
      shift_(lattice_corner(*body.cells, body.lattice)),
      whole_or_gone_(body.lattice.has_cells) {}

unsigned CellsNow::left_of(const Vec3i& cell) const noexcept {
  if (whole_or_gone_) return (net_.mask(mass(cell)) & cell_bit(7)) != 0 ? whole : 0;
  unsigned left = 0;
  bool all = true;
  for (unsigned n = 0; n < 8; ++n) {
    const Vec3i corner = cell + corner_of(n);
    if (!is_odd(corner)) continue;
    std::array<Vec3i, 3> even;
    for (unsigned a = 0; a < 3; ++a) even[a] = cell + corner_of(n ^ (1U << a));
    bool filled = is_triangle(even[0], even[1], even[2]);
    for (const Vec3i& other : even) filled = net_.joined(corner - shift_, other - shift_) && filled;
    if (filled) left |= 1U << n;
    all = all && filled;
  }
  if (all) return whole;
  // The middle tetrahedron: its four faces are those towards the corner tetrahedra.
  bool filled = true;
  for (unsigned n = 0; n < 8; ++n) {
    if (!is_odd(cell + corner_of(n))) continue;
    filled =
        filled && is_triangle(cell + corner_of(n ^ 1U), cell + corner_of(n ^ 2U), cell + corner_of(n ^ 4U));
  }
  return filled ? left | 1U << middle : left;
}

unsigned CellsNow::left_of_any(const Vec3i& cell) const noexcept {
  if (!cells_.is_deformable(cell.x(), cell.y(), cell.z())) return whole;
  for (unsigned n = 0; n < 8; ++n)
    if (const Index at = mass(cell + corner_of(n)); at >= 0 && net_.has_lost(at)) return left_of(cell);
  return whole;
}

bool CellsNow::is_triangle(const Vec3i& a, const Vec3i& b, const Vec3i& c) const noexcept {
  return !whole_or_gone_ && net_.joined(a - shift_, b - shift_) && net_.joined(b - shift_, c - shift_) &&
         net_.joined(a - shift_, c - shift_);
}

CellAndNeighbours::CellAndNeighbours(const CellsNow& now, const Vec3i& cell) noexcept
    : now_(now), cell_(cell) {
  left_[13] = now.left_of_any(cell);
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {-1, 1}) {
      const Vec3i by = sign * Vec3i::Unit(axis);
      left_[static_cast<std::size_t>(13 + by.dot(Vec3i(1, 3, 9)))] = now.left_of_any(cell + by);
    }
}

CutCells::CutCells(const Body& body, const LiveElements& live)
    : cells_(*body.cells), now_(body, live.masks()) {
  const Lattice& lattice = body.lattice;
  for (const Index mass : lattice.masses) {
    if (live.mask(mass) == lattice.mask[static_cast<std::size_t>(mass)]) continue;
    if (seen_.empty()) {
      seen_.resize(cells_.filled.size());
      is_cut_.resize(cells_.filled.size());
    }
    const Vec3i at = lattice.grid_of(mass) + now_.shift();
    for (unsigned n = 0; n < 8; ++n) {
      const Vec3i cell = at - corner_of(n);
      if (!cells_.is_deformable(cell.x(), cell.y(), cell.z())) continue;
      const std::size_t i = cells_.index(cell.x(), cell.y(), cell.z());
      if (seen_[i]) continue;
      seen_[i] = true;
      const unsigned left = now_.left_of(cell);
      if (left == CellsNow::whole) continue;
      is_cut_[i] = true;
      left_.emplace(i, left);
      list_.push_back(cell);
    }
  }
}

bool CutCells::is_cut(const Vec3i& cell) const {
  return any() && cells_.inside(cell.x(), cell.y(), cell.z()) &&
         is_cut_[cells_.index(cell.x(), cell.y(), cell.z())];
}

bool CutCells::corner_filled(const Vec3i& cell, const Vec3i& corner) const {
  return CellsNow::has_corner(left_.at(cells_.index(cell.x(), cell.y(), cell.z())), corner - cell);
}

bool CutCells::middle_filled(const Vec3i& cell) const {
  return CellsNow::has_middle(left_.at(cells_.index(cell.x(), cell.y(), cell.z())));
}

}  // namespace palpate::physics
