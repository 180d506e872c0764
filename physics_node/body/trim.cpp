#include "physics_node/body/trim.h"

namespace palpate::physics {
namespace {

std::vector<Vec3i> all_directions(LatticeKind kind) {
  auto directions = half_directions(kind);
  const std::size_t n_half = directions.size();
  for (std::size_t d = 0; d < n_half; ++d) directions.emplace_back(-directions[d]);
  return directions;
}

std::vector<Index> masses_of(const Lattice& lattice) {
  std::vector<Index> masses;
  for (Index cell = 0; cell < lattice.n_cells(); ++cell)
    if (lattice.mass_share[static_cast<std::size_t>(cell)] > 0) masses.push_back(cell);
  return masses;
}

template <class Visit>
void for_each_neighbour(const Lattice& lattice, const std::vector<Vec3i>& directions, Index cell,
                        const Visit& visit) {
  const Vec3i at = lattice.grid_of(cell);
  for (const Vec3i& d : directions)
    if (const Index other = lattice.mass_at(at + d); other >= 0) visit(other);
}

}  // namespace

bool keep_outer_layers(Lattice& lattice, int layers, const std::function<bool(const Vec3i&)>& outside) {
  const auto directions = all_directions(lattice.kind);
  const auto masses = masses_of(lattice);
  std::vector<std::uint8_t> found(static_cast<std::size_t>(lattice.n_cells()), 0);
  std::vector<Index> layer;
  for (const Index cell : masses)
    for (const Vec3i& d : directions) {
      if (!outside(lattice.grid_of(cell) + d)) continue;
      found[static_cast<std::size_t>(cell)] = 1;
      layer.push_back(cell);
      break;
    }
  for (int n = 1; n < layers; ++n) {
    std::vector<Index> next;
    for (const Index cell : layer)
      for_each_neighbour(lattice, directions, cell, [&](Index other) {
        if (found[static_cast<std::size_t>(other)] != 0) return;
        found[static_cast<std::size_t>(other)] = 1;
        next.push_back(other);
      });
    layer = std::move(next);
  }
  bool any_within = false;
  for (const Index cell : masses) {
    if (found[static_cast<std::size_t>(cell)] != 0) continue;
    lattice.mass_share[static_cast<std::size_t>(cell)] = 0;
    any_within = true;
  }
  return any_within;
}

void drop_loose_masses(Lattice& lattice, int fewest) {
  const auto directions = all_directions(lattice.kind);
  auto to_look_at = masses_of(lattice);
  while (!to_look_at.empty()) {
    const Index cell = to_look_at.back();
    to_look_at.pop_back();
    auto& share = lattice.mass_share[static_cast<std::size_t>(cell)];
    if (share <= 0) continue;
    std::vector<Index> neighbours;
    for_each_neighbour(lattice, directions, cell, [&](Index other) { neighbours.push_back(other); });
    if (static_cast<int>(neighbours.size()) >= fewest) continue;
    share = 0;
    to_look_at.insert(to_look_at.end(), neighbours.begin(), neighbours.end());
  }
}

void keep_largest_part(Lattice& lattice) {
  const auto directions = all_directions(lattice.kind);
  const auto masses = masses_of(lattice);
  std::vector<std::uint32_t> part(static_cast<std::size_t>(lattice.n_cells()), 0);
  std::uint32_t n_parts = 0, largest = 0;
  std::size_t most = 0;
  std::vector<Index> stack;
  for (const Index start : masses) {
    if (part[static_cast<std::size_t>(start)] != 0) continue;
    part[static_cast<std::size_t>(start)] = ++n_parts;
    stack.assign(1, start);
    std::size_t count = 0;
    while (!stack.empty()) {
      const Index cell = stack.back();
      stack.pop_back();
      ++count;
      for_each_neighbour(lattice, directions, cell, [&](Index other) {
        if (part[static_cast<std::size_t>(other)] != 0) return;
        part[static_cast<std::size_t>(other)] = n_parts;
        stack.push_back(other);
      });
    }
    if (count <= most) continue;
    most = count;
    largest = n_parts;
  }
  for (const Index cell : masses)
    if (part[static_cast<std::size_t>(cell)] != largest)
      lattice.mass_share[static_cast<std::size_t>(cell)] = 0;
}

}  // namespace palpate::physics
