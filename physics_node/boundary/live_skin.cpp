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
      next_(as_loaded.bearers.size(), none) {
  if (body_.cell_net() != nullptr) {
    lip_of_.assign(static_cast<std::size_t>(body_.capacity()), -1);
    lips_.reserve(4 * body_.most_copies());
  }
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
  std::fill(lip_of_.begin(), lip_of_.end(), -1);
  lips_.clear();
}

void LiveSkin::look_at(const Vec3i& cell) noexcept {
  const auto alive = [this](const Vec3i& c) { return cells_.left_of_any(c) == CellsNow::whole; };
  for (unsigned o = 0; o < 8; ++o) {
    const Vec3i corner = SmoothSkin::cell_at(cell + Vec3i::Ones(), o);
    const Index mass = cells_.mass(corner);
    if (mass < 0) continue;
    if (body_.cell_net() != nullptr) {
      look_at_cut(corner, mass);
      continue;
    }
    for (std::uint32_t v = first_[static_cast<std::size_t>(mass)]; v != none; v = next_[v])
      now_[v] = skin_.bearers(corner, as_loaded_.fan[v], as_loaded_.rest[v], alive);
  }
}

CellsRound LiveSkin::cells_round(Index node) const noexcept {
  const CellNet& net = *body_.cell_net();
  CellsRound round;
  net.each_around(node, [&](Index cell, std::size_t k) {
    round.corners[7 - k] = net.corners(cell);
    round.has[7 - k] = round.corners[7 - k][k] == node;
    for (std::size_t axis = 0; axis < 3; ++axis) round.cut_at[7 - k][axis] = net.cut_at(cell, axis);
  });
  return round;
}

/// The vertices of a node as loaded, and the lips of all that have come of it.
void LiveSkin::look_at_cut(const Vec3i& corner, Index mass) noexcept {
  const CellNet& net = *body_.cell_net();
  const CellsRound round = cells_round(mass);
  for (std::uint32_t v = first_[static_cast<std::size_t>(mass)]; v != none; v = next_[v])
    now_[v] = skin_.bearers_of_part(corner, as_loaded_.fan[v], as_loaded_.rest[v], mass,
                                    [&](unsigned o) { return round.corners_at(o); });
  put_lip(corner, mass);
  if (!net.has_split(mass)) return;
  net.each_around(mass, [&](Index cell, std::size_t k) {
    if (const Index node = net.corners(cell)[k]; node != mass) put_lip(corner, node);
  });
}

void LiveSkin::put_lip(const Vec3i& corner, Index node) noexcept {
  const CellsRound round = cells_round(node);
  const CutLip cut = lip_of(round, body_.cells->spacing);
  std::int32_t& number = lip_of_[static_cast<std::size_t>(node)];
  if (cut.n == 0 || (number < 0 && lips_.size() == lips_.capacity())) return;
  if (number < 0) {
    number = static_cast<std::int32_t>(lips_.size());
    lips_.emplace_back();
  }
  const Index mass = body_.origin(node);
  const std::uint32_t first = first_[static_cast<std::size_t>(mass)];
  const int fan = first == none ? 0 : as_loaded_.fan[first];
  Lip& lip = lips_[static_cast<std::size_t>(number)];
  const Vec3 at_node = body_.rest_position(mass);
  lip.rest = first == none ? Vec3(at_node + cut.place)
                           : Vec3(as_loaded_.rest[first] + cut.from_skin(as_loaded_.rest[first] - at_node));
  lip.by =
      skin_.bearers_of_part(corner, fan, lip.rest, node, [&](unsigned o) { return round.corners_at(o); });
}

}  // namespace palpate::physics
