#include "physics_node/boundary/live_elements.h"

#include <algorithm>

namespace palpate::physics {

LiveElements::LiveElements(const Body& body) : mask_(static_cast<std::size_t>(body.lattice.n_cells())) {}

LiveElements::LiveElements(const Topology& moving) : LiveElements(moving.body()) { copy(moving); }

void LiveElements::copy(const Topology& moving) { copy(moving.body(), moving.adjacency()); }

void LiveElements::copy_faces(const Body& body) {
  faces_.clear();
  if (body.mesh->triangles) return copy_triangles(*body.mesh->triangles);
  if (!body.mesh->net) return;
  const TetNet& net = *body.mesh->net;
  for (Index tet = 0; tet < net.n_elements(); ++tet)
    for (std::size_t f = 0; f < 4; ++f) {
      if (!net.is_exposed(tet, f)) continue;
      const MeshTriangle face = net.face(tet, f);
      faces_.push_back({tet,
                        net.beyond(tet, f) == TetNet::none,
                        face,
                        {net.origin(face[0]), net.origin(face[1]), net.origin(face[2])}});
    }
}

void LiveElements::copy_triangles(const TriangleNet& net) {
  for (Index triangle = 0; triangle < net.n_elements(); ++triangle) {
    const MeshTriangle& of = net.corners(triangle);
    bool beside_cut = false;
    for (std::size_t side = 0; side < 3; ++side)
      beside_cut = beside_cut || (net.is_open(triangle, side) && net.is_exposed(triangle, side));
    faces_.push_back({triangle, !beside_cut, of, {net.origin(of[0]), net.origin(of[1]), net.origin(of[2])}});
  }
}

void LiveElements::copy_parted(const Body& body) {
  parted_.clear();
  const CellNet* net = body.cell_net();
  if (net == nullptr) return;
  std::vector<Index> cells(net->parted().begin(), net->parted().end());
  cells.insert(cells.end(), net->opened().begin(), net->opened().end());
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  for (const Index cell : cells) {
    PartedCell& one = parted_.emplace_back(PartedCell{cell, net->corners(cell), 0, {}});
    for (std::size_t axis = 0; axis < 3; ++axis) one.cut_at[axis] = net->cut_at(cell, axis);
    for (std::size_t f = 0; f < CellNet::n_faces; ++f)
      if (net->beyond(cell, f) != CellNet::none && net->is_exposed(cell, f))
        one.open = static_cast<std::uint8_t>(one.open | 1U << f);
  }
}

const LiveElements::PartedCell* LiveElements::parted(Index cell) const noexcept {
  const auto at = std::ranges::lower_bound(parted_, cell, {}, &PartedCell::cell);
  return at != parted_.end() && at->cell == cell ? &*at : nullptr;
}

void LiveElements::copy(const Body& body, const Adjacency& from) {
  if (body.mesh) return copy_faces(body);
  copy_parted(body);
  for (const Index node : body.nodes()) mask_[static_cast<std::size_t>(node)] = from.live_elements(node);
}

void LiveElements::copy(const Body& body, std::span<const Mask> recorded) {
  if (body.mesh) return copy_faces(body);
  for (std::size_t n = 0; n < body.nodes().size(); ++n)
    mask_[static_cast<std::size_t>(body.nodes()[n])] = recorded[n];
}

LiveNet::LiveNet(const Lattice& lattice, std::span<const Mask> masks) : lattice_(lattice), masks_(masks) {
  direction_.fill(-1);
  const auto directions = all_directions(lattice.kind);
  for (std::size_t d = 0; d < directions.size(); ++d) direction_[key(directions[d])] = static_cast<int>(d);
}

bool LiveNet::joined(const Vec3i& a, const Vec3i& b) const {
  const Index cell = mass(a);
  return cell >= 0 && alive(mask(cell), b - a);
}

std::vector<Vec3i> all_directions(LatticeKind kind) {
  std::vector<Vec3i> directions = half_directions(kind);
  const std::size_t n_half = directions.size();
  for (std::size_t d = 0; d < n_half; ++d) directions.emplace_back(-directions[d]);
  return directions;
}

}  // namespace palpate::physics
