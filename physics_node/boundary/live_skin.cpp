#include "physics_node/boundary/live_skin.h"

#include <algorithm>

namespace palpate::physics {

LiveSkin::LiveSkin(const Topology& moving, const Surface& as_loaded)
    : body_(moving.body()),
      as_loaded_(as_loaded),
      skin_(moving.body(), std::nullopt),
      cells_(moving.body(), moving.adjacency().of_all()),
      now_(as_loaded.bearers),
      first_(static_cast<std::size_t>(moving.body().lattice.n_cells()), none),
      next_(as_loaded.bearers.size(), none),
      of_copy_(moving.body().most_copies()) {
  // The first fan comes first in the list of its mass.
  for (const bool of_first : {false, true})
    for (std::uint32_t v = 0; v < now_.size(); ++v) {
      if (as_loaded.fan[v] == no_fan || (as_loaded.fan[v] == 0) != of_first) continue;
      std::uint32_t& first = first_[static_cast<std::size_t>(as_loaded.cell[v])];
      next_[v] = first;
      first = v;
    }
}

void LiveSkin::restart() noexcept {
  std::copy(as_loaded_.bearers.begin(), as_loaded_.bearers.end(), now_.begin());
}

void LiveSkin::look_at(const Vec3i& cell) noexcept {
  const auto alive = [this](const Vec3i& c) { return cells_.left_of_any(c) == CellsNow::whole; };
  for (unsigned o = 0; o < 8; ++o) {
    const Vec3i corner = SmoothSkin::cell_at(cell + Vec3i::Ones(), o);
    const Index mass = cells_.mass(corner);
    if (mass < 0) continue;
    const CellNet* net = body_.cell_net();
    const std::uint32_t first = first_[static_cast<std::size_t>(mass)];
    for (std::uint32_t v = first; v != none; v = next_[v])
      now_[v] = net != nullptr ? bearers_of_part(corner, v, mass)
                               : skin_.bearers(corner, as_loaded_.fan[v], as_loaded_.rest[v], alive);
    if (net == nullptr || first == none || !net->has_split(mass)) continue;
    net->each_around(mass, [&](Index at, std::size_t k) {
      if (const Index node = net->corners(at)[k]; node != mass)
        of_copy_[static_cast<std::size_t>(node - net->n_loaded())] = bearers_of_part(corner, first, node);
    });
  }
}

Bearers LiveSkin::bearers_of_part(const Vec3i& corner, std::uint32_t vertex, Index node) const noexcept {
  const CellNet& net = *body_.cell_net();
  std::array<CellNet::Corners, 8> corners{};
  std::array<bool, 8> has{};
  net.each_corner(node,
                  [&](Index cell, std::size_t k) { corners[7 - k] = net.corners(cell), has[7 - k] = true; });
  return skin_.bearers_of_part(corner, as_loaded_.fan[vertex], as_loaded_.rest[vertex], node,
                               [&](unsigned octant) { return has[octant] ? &corners[octant] : nullptr; });
}

}  // namespace palpate::physics
