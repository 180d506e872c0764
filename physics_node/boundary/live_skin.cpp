#include "physics_node/boundary/live_skin.h"

#include <algorithm>

namespace palpate::physics {

LiveSkin::LiveSkin(const Topology& moving, const Surface& as_loaded)
    : as_loaded_(as_loaded),
      skin_(moving.body(), std::nullopt),
      cells_(moving.body(), moving.adjacency().of_all()),
      now_(as_loaded.bearers),
      first_(static_cast<std::size_t>(moving.body().lattice.n_cells()), none),
      next_(as_loaded.bearers.size(), none) {
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
    for (std::uint32_t v = first_[static_cast<std::size_t>(mass)]; v != none; v = next_[v])
      now_[v] = skin_.bearers(corner, as_loaded_.fan[v], as_loaded_.rest[v], alive);
  }
}

}  // namespace palpate::physics
