#include "physics_node/step/multigrid/grid_level.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace palpate::physics {
namespace {

struct NumberedNode {
  GridPlace at{};
  int copy = 0;  // among nodes of one place
  Index before = 0;
};

std::vector<NumberedNode> nodes_of(const GridLevel& level, Index n_before) {
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(n_before), 0);
  std::vector<NumberedNode> nodes;
  for (const GridCell& cell : level.cells)
    for (int a = 0; a < 8; ++a) {
      const Index id = cell.corner[static_cast<std::size_t>(a)];
      if (seen[static_cast<std::size_t>(id)]++ != 0) continue;
      nodes.push_back({{cell.at[0] + (a & 1), cell.at[1] + (a >> 1 & 1), cell.at[2] + (a >> 2)}, 0, id});
    }
  return nodes;
}

}  // namespace

std::vector<Index> number_nodes(GridLevel& level, Index n_before) {
  std::vector<NumberedNode> nodes = nodes_of(level, n_before);
  const auto upwards = [](const NumberedNode& n) { return std::tuple(n.at[2], n.at[1], n.at[0]); };
  std::ranges::sort(nodes, {}, [&](const NumberedNode& n) { return std::tuple(upwards(n), n.before); });
  for (std::size_t n = 1; n < nodes.size(); ++n)
    if (nodes[n].at == nodes[n - 1].at) nodes[n].copy = nodes[n - 1].copy + 1;
  std::ranges::sort(nodes, {}, [](const NumberedNode& n) {
    return std::tuple(n.at[2], n.copy, n.at[1], n.at[0], n.before);
  });
  std::vector<Index> number(static_cast<std::size_t>(n_before), -1);
  level.planes.clear();
  level.place.clear();
  for (const NumberedNode& node : nodes) {
    while (static_cast<int>(level.planes.size()) <= node.at[2]) {
      if (!level.planes.empty()) level.place.resize(level.place.size() + room_between_planes);
      const auto next = static_cast<Index>(level.place.size());
      level.planes.push_back({next, next});
    }
    number[static_cast<std::size_t>(node.before)] = static_cast<Index>(level.place.size());
    level.place.push_back(node.at);
    level.planes.back().last = static_cast<Index>(level.place.size());
  }
  level.place.resize(level.place.size() + room_between_planes);
  level.n_nodes = static_cast<Index>(level.place.size());
  level.held.assign(level.place.size(), 1);
  for (const GridPlane& plane : level.planes)
    std::fill(level.held.begin() + plane.first, level.held.begin() + plane.last, std::uint8_t{0});
  for (GridCell& cell : level.cells)
    for (Index& corner : cell.corner) corner = number[static_cast<std::size_t>(corner)];
  return number;
}

BodyGrid body_grid(const Body& body) {
  const Lattice& lattice = body.lattice;
  BodyGrid grid;
  GridLevel& level = grid.level;
  level.edge = lattice.step;
  Vec3i lowest = Vec3i::Constant(std::numeric_limits<int>::max());
  for (const Index node : body.nodes()) lowest = lowest.cwiseMin(lattice.grid_of(node));
  for (const Index node : body.nodes()) {
    const float stiffness = body.solid->stiffness[static_cast<std::size_t>(node)];
    if (stiffness <= 0) continue;
    const Vec3i at = lattice.grid_of(node);
    GridCell cell;
    for (int a = 0; a < 8; ++a)
      cell.corner[static_cast<std::size_t>(a)] = lattice.cell_of(at + Vec3i(a & 1, a >> 1 & 1, a >> 2));
    cell.at = {at.x() - lowest.x(), at.y() - lowest.y(), at.z() - lowest.z()};
    cell.stiffness = static_cast<double>(stiffness);
    level.cells.push_back(cell);
  }
  // Rows of the lattice are stored with even x before odd.
  std::ranges::sort(level.cells, {}, [](const GridCell& c) { return std::tuple(c.at[2], c.at[1], c.at[0]); });
  const std::vector<Index> number = number_nodes(level, body.capacity());
  grid.storage.assign(static_cast<std::size_t>(level.n_nodes), -1);
  for (const Index node : body.nodes()) {
    const Index n = number[static_cast<std::size_t>(node)];
    if (n < 0) continue;
    grid.storage[static_cast<std::size_t>(n)] = node;
    level.held[static_cast<std::size_t>(n)] = body.inverse_mass[static_cast<std::size_t>(node)] == 0 ? 1 : 0;
  }
  return grid;
}

}  // namespace palpate::physics
