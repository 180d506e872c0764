#include "physics_node/lattice/cell_net.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr std::array<std::array<std::size_t, 4>, CellNet::n_faces> face_corners{{
    {0, 4, 6, 2},
    {1, 3, 7, 5},
    {0, 1, 5, 4},
    {2, 6, 7, 3},
    {0, 2, 3, 1},
    {4, 5, 7, 6},
}};
constexpr std::size_t most_splits_a_face = 4;  // one at each of its corners

}  // namespace

const std::array<std::size_t, 4>& CellNet::corners_of_face(std::size_t face) noexcept {
  return face_corners[face];
}

CellNet::CellNet(const Lattice& lattice, std::span<const float> stiffness, std::size_t most_copies)
    : n_loaded_(lattice.n_cells()),
      steps_(lattice),
      most_copies_(most_copies),
      is_cell_(stiffness.size(), 0),
      open_(stiffness.size(), 0),
      cut_(3 * stiffness.size(), 0),
      record_(stiffness.size(), -1),
      has_split_(stiffness.size(), 0) {
  for (const Index cell : lattice.masses)
    if (stiffness[at(cell)] > 0) is_cell_[at(cell)] = 1, cells_.push_back(cell);
  const std::size_t most_parted = std::min(7 * most_copies, cells_.size());
  parted_.reserve(most_parted);
  corners_.reserve(most_parted);
  origin_.reserve(most_copies);
  opened_.reserve(cells_.size());
  cuts_.reserve(std::min(2 * most_copies, 3 * cells_.size()));
  open_faces_.reserve(cuts_.capacity());
  splits_.reserve(most_copies);
}

/// There is a halo of empty storage around all masses, so that one step aside is always within it.
Index CellNet::with_corner(Index node, std::size_t corner) const noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if ((corner >> axis & 1) != 0) node = steps_.beside(node, 2 * axis);
  return node;
}

CellNet::Face CellNet::face(Index cell, std::size_t face) const noexcept {
  const Corners of = corners(cell);
  const auto& k = face_corners[face];
  return {of[k[0]], of[k[1]], of[k[2]], of[k[3]]};
}

bool CellNet::is_exposed(Index cell, std::size_t face) const noexcept {
  const Index other = beyond(cell, face);
  if (other == none) return true;
  if (!is_open(cell, face)) return false;
  const Face mine = this->face(cell, face);
  const Corners theirs = corners(other);
  return std::ranges::any_of(mine,
                             [&](Index node) { return std::ranges::find(theirs, node) == theirs.end(); });
}

bool CellNet::is_exposed(Index node) const noexcept {
  bool is = false;
  each_corner(node, [&](Index cell, std::size_t corner) {
    for (std::size_t axis = 0; axis < 3 && !is; ++axis)
      is = is_exposed(cell, 2 * axis + (corner >> axis & 1));
  });
  return is;
}

std::size_t CellNet::face_between(Index a, Index b) const noexcept {
  std::size_t f = 0;
  while (f < n_faces && beyond(a, f) != b) ++f;
  return f;
}

bool CellNet::open(Index a, Index b, const FaceCut& cut) noexcept {
  if (a < 0 || a >= n_loaded() || !has_cell(a)) return false;
  const std::size_t f = face_between(a, b);
  if (f == n_faces || is_open(a, f)) return false;
  if (most_copies_ - origin_.size() < most_splits_a_face || cuts_.size() == cuts_.capacity()) {
    ++left_out_;
    return false;
  }
  for (const Index cell : {a, b})
    if (open_[at(cell)] == 0) opened_.push_back(cell);
  const bool upwards = f % 2 == 1;
  cut_[3 * at(upwards ? a : b) + f / 2] = static_cast<std::int32_t>(cuts_.size());
  open_faces_.push_back({upwards ? a : b, f / 2});
  cuts_.push_back({std::clamp(upwards ? cut.share : 1 - cut.share, 0.0F, 1.0F), cut.normal});
  open_[at(a)] = static_cast<std::uint8_t>(open_[at(a)] | 1U << f);
  open_[at(b)] = static_cast<std::uint8_t>(open_[at(b)] | 1U << (f ^ 1U));
  ++n_open_;
  for (const std::size_t c : face_corners[f]) {
    const Index node = corners(a)[c];
    if (node == corners(b)[c ^ (std::size_t{1} << f / 2)]) part(node, a);
  }
  return true;
}

void CellNet::give(Index cell, std::size_t corner, Index copy) noexcept {
  std::int32_t& record = record_[at(cell)];
  if (record < 0) {
    record = static_cast<std::int32_t>(parted_.size());
    corners_.push_back(loaded_corners(cell));
    parted_.push_back(cell);
  }
  corners_[at(record)][corner] = copy;
}

/// A node one of whose faces has opened, at `from`: does what is left of its cells still hang together?
void CellNet::part(Index node, Index from) noexcept {
  std::array<Index, 8> fan{}, rest{};  // cells; by the corner at which they have the node
  fan.fill(none), rest.fill(none);
  std::size_t n_rest = 0, n_fan = 0;
  each_corner(node, [&](Index cell, std::size_t corner) { rest[corner] = cell, ++n_rest; });
  const auto reach = [&](std::size_t corner) {
    fan[corner] = rest[corner], rest[corner] = none;
    ++n_fan, --n_rest;
  };
  for (std::size_t c = 0; c < 8; ++c)
    if (rest[c] == from) reach(c);
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t c = 0; c < 8; ++c)
      for (std::size_t axis = 0; axis < 3 && fan[c] != none; ++axis) {
        const std::size_t beside = c ^ std::size_t{1} << axis;
        // A cell that has the node at its upper corner lies below the one that has it at its lower corner.
        if (rest[beside] == none || is_open(fan[c], 2 * axis + (c >> axis & 1))) continue;
        reach(beside);
        grown = true;
      }
  }
  if (n_rest == 0) return;
  // On a tie the part that has the lowest cell keeps the node.
  std::size_t first = 8;
  while (fan[first - 1] == none && rest[first - 1] == none) --first;
  const bool gives = n_fan < n_rest || (n_fan == n_rest && fan[first - 1] == none);
  const Index copy = n_nodes();
  const Index loaded = origin(node);
  origin_.push_back(loaded);
  has_split_[at(loaded)] = 1;
  splits_.push_back({node, copy});
  for (std::size_t c = 0; c < 8; ++c)
    if (const Index cell = gives ? fan[c] : rest[c]; cell != none) give(cell, c, copy);
}

void CellNet::forget_cuts() noexcept {
  for (const Index cell : parted_) record_[at(cell)] = -1;
  parted_.clear();
  opened_.clear();
  cuts_.clear();
  open_faces_.clear();
  corners_.clear();
  std::ranges::fill(open_, std::uint8_t{0});
  splits_.clear();
  n_open_ = 0;
  ++n_resets_;
}

}  // namespace palpate::physics
