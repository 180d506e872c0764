#include "physics_node/step/multigrid/coarsen.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace palpate::physics {
namespace {

/// Sets of numbers that grow together; each is called by its least member.
class Union {
 public:
  explicit Union(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index find(Index n) {
    while (at(n) != n) n = at(n) = at(at(n));
    return n;
  }
  void join(Index a, Index b) {
    a = find(a), b = find(b);
    at(std::max(a, b)) = std::min(a, b);
  }

 private:
  Index& at(Index n) { return parent_[static_cast<std::size_t>(n)]; }
  std::vector<Index> parent_;
};

GridPlace halved(const GridPlace& at) { return {at[0] / 2, at[1] / 2, at[2] / 2}; }
GridPlace corner_place(const GridPlace& at, int a) {
  return {at[0] + (a & 1), at[1] + (a >> 1 & 1), at[2] + (a >> 2)};
}

/// Coarse cells; their corners are slots 8 cell + corner.
void make_cells(GridLevel& fine, GridLevel& coarse) {
  std::vector<std::size_t> order(fine.cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t n) {
    const GridPlace at = halved(fine.cells[n].at);
    return std::tuple(at[2], at[1], at[0]);
  };
  std::ranges::stable_sort(order, {}, key);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && key(order[end]) == key(order[begin])) ++end;
    Union parts(end - begin);
    for (std::size_t m = begin; m < end; ++m)
      for (std::size_t n = begin; n < m; ++n) {
        const auto& a = fine.cells[order[m]].corner;
        const auto& b = fine.cells[order[n]].corner;
        if (std::ranges::find_first_of(a, b) != a.end())
          parts.join(static_cast<Index>(m - begin), static_cast<Index>(n - begin));
      }
    for (std::size_t m = begin; m < end; ++m) {
      const Index first = parts.find(static_cast<Index>(m - begin));
      GridCell& child = fine.cells[order[m]];
      if (first == static_cast<Index>(m - begin)) {
        child.parent = static_cast<Index>(coarse.cells.size());
        GridCell cell;
        cell.at = halved(child.at);
        for (std::size_t a = 0; a < 8; ++a) cell.corner[a] = 8 * child.parent + static_cast<Index>(a);
        coarse.cells.push_back(cell);
      } else {
        child.parent = fine.cells[order[begin + static_cast<std::size_t>(first)]].parent;
      }
      coarse.cells[static_cast<std::size_t>(child.parent)].stiffness += child.stiffness / 8;
    }
  }
}

/// Joins the corners that two coarse cells have at the same places.
void join_corners(const GridLevel& coarse, Index one, Index other, Union& slots) {
  const GridPlace a = coarse.cells[static_cast<std::size_t>(one)].at,
                  b = coarse.cells[static_cast<std::size_t>(other)].at;
  for (int c = 0; c < 8; ++c) {
    const GridPlace at = corner_place(a, c);
    int d = 0;
    bool shared = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const int bit = at[i] - b[i];
      shared = shared && (bit == 0 || bit == 1);
      d |= bit << i;
    }
    if (shared) slots.join(8 * one + c, 8 * other + d);
  }
}

void merge_corners(const GridLevel& fine, GridLevel& coarse) {
  std::vector<std::vector<Index>> around(static_cast<std::size_t>(fine.n_nodes));  // coarse cells
  for (const GridCell& cell : fine.cells)
    for (const Index node : cell.corner) {
      auto& cells = around[static_cast<std::size_t>(node)];
      if (std::ranges::find(cells, cell.parent) == cells.end()) cells.push_back(cell.parent);
    }
  Union slots(8 * coarse.cells.size());
  for (const auto& cells : around)
    for (std::size_t m = 0; m < cells.size(); ++m)
      for (std::size_t n = 0; n < m; ++n) join_corners(coarse, cells[m], cells[n], slots);
  for (GridCell& cell : coarse.cells)
    for (Index& corner : cell.corner) corner = slots.find(corner);
}

void sort_cells(GridLevel& fine, GridLevel& coarse) {
  std::vector<std::size_t> order(coarse.cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t n) {
    return std::tuple(coarse.cells[n].at[2], coarse.cells[n].corner[0], n);
  });
  std::vector<GridCell> sorted;
  std::vector<Index> rank(order.size());
  for (const std::size_t n : order) {
    rank[n] = static_cast<Index>(sorted.size());
    sorted.push_back(coarse.cells[n]);
  }
  coarse.cells = std::move(sorted);
  for (GridCell& cell : fine.cells) cell.parent = rank[static_cast<std::size_t>(cell.parent)];
}

/// Trilinear shares of the corners of its coarse cell in a place of the finer level, at `local` = 0, 1 or 2 along each axis.
template <class Visit>
void trilinear(const GridPlace& local, const GridCell& cell, const Visit& visit) {
  for (std::size_t a = 0; a < 8; ++a) {
    float share = 1;
    for (std::size_t i = 0; i < 3; ++i)
      share *= 0.5F * static_cast<float>((a >> i & 1) != 0 ? local[i] : 2 - local[i]);
    if (share > 0) visit(cell.corner[a], share);
  }
}

ShareTable table_of(const std::vector<std::vector<NodeShare>>& lists) {
  ShareTable table;
  table.begin.push_back(0);
  for (const auto& list : lists) {
    table.shares.insert(table.shares.end(), list.begin(), list.end());
    table.begin.push_back(static_cast<Index>(table.shares.size()));
  }
  return table;
}

/// Shares of the corners of a fine cell in a place outside it, as if its displacement were linear.
void reach_out(const GridCell& cell, const std::array<double, 3>& from_centre, std::vector<NodeShare>& list) {
  list.clear();
  for (std::size_t a = 0; a < 8; ++a) {
    double share = 0.125;
    for (std::size_t i = 0; i < 3; ++i) share += ((a >> i & 1) != 0 ? 0.25 : -0.25) * from_centre[i];
    list.push_back({cell.corner[a], static_cast<float>(share)});
  }
}

/// For coarse nodes without a fine one at their place.
void reach_beyond(const GridLevel& fine, const GridLevel& coarse,
                  std::vector<std::vector<NodeShare>>& inject) {
  std::vector<double> nearest(inject.size());
  for (std::size_t n = 0; n < inject.size(); ++n)
    nearest[n] = inject[n].empty() ? std::numeric_limits<double>::infinity() : 0;
  for (const GridCell& cell : fine.cells) {
    const GridCell& parent = coarse.cells[static_cast<std::size_t>(cell.parent)];
    for (int a = 0; a < 8; ++a) {
      const auto node = static_cast<std::size_t>(parent.corner[static_cast<std::size_t>(a)]);
      const GridPlace at = corner_place(parent.at, a);
      std::array<double, 3> d{};
      double far = 0;
      for (std::size_t i = 0; i < 3; ++i) d[i] = 2 * at[i] - (cell.at[i] + 0.5), far += d[i] * d[i];
      if (far >= nearest[node]) continue;
      nearest[node] = far;
      reach_out(cell, d, inject[node]);
    }
  }
}

/// Calls visit(fine node, corner of its coarse cell, share) for the corners of a cell.
template <class Visit>
void for_shares(const GridLevel& fine, const GridCell& cell, const GridLevel& coarse, const Visit& visit) {
  const GridCell& parent = coarse.cells[static_cast<std::size_t>(cell.parent)];
  for (const Index node : cell.corner) {
    GridPlace local{};
    for (std::size_t i = 0; i < 3; ++i)
      local[i] = fine.place[static_cast<std::size_t>(node)][i] - 2 * parent.at[i];
    trilinear(local, parent, [&](Index to, float share) { visit(node, to, share); });
  }
}

/// A coarse node is held if its fine one is, and if that says it all: in every coarse cell around it a fine node is held if and
/// only if all those are that it lies between.
void hold(const GridLevel& fine, GridLevel& coarse) {
  std::vector<std::uint8_t> candidate(static_cast<std::size_t>(coarse.n_nodes), 0),
      said(coarse.cells.size(), 1);
  const auto is_held = [&](Index node) { return fine.held[static_cast<std::size_t>(node)] != 0; };
  for (const GridCell& cell : fine.cells)
    for_shares(fine, cell, coarse, [&](Index node, Index to, float share) {
      if (share == 1 && is_held(node)) candidate[static_cast<std::size_t>(to)] = 1;
    });
  for (const GridCell& cell : fine.cells)
    for_shares(fine, cell, coarse, [&](Index node, Index to, float) {
      if (is_held(node) && candidate[static_cast<std::size_t>(to)] == 0)
        said[static_cast<std::size_t>(cell.parent)] = 0;
    });
  for (std::size_t c = 0; c < coarse.cells.size(); ++c)
    for (const Index corner : coarse.cells[c].corner)
      if (said[c] == 0) candidate[static_cast<std::size_t>(corner)] = 0;
  for (std::size_t n = 0; n < candidate.size(); ++n)
    if (candidate[n] != 0) coarse.held[n] = 1;
}

}  // namespace

CoarserLevel coarsen(GridLevel& fine) {
  CoarserLevel next;
  GridLevel& coarse = next.level;
  coarse.edge = 2 * fine.edge;
  make_cells(fine, coarse);
  merge_corners(fine, coarse);
  number_nodes(coarse, static_cast<Index>(8 * coarse.cells.size()));
  sort_cells(fine, coarse);
  hold(fine, coarse);
  std::vector<std::vector<NodeShare>> down(static_cast<std::size_t>(fine.n_nodes));
  std::vector<std::vector<NodeShare>> up(static_cast<std::size_t>(coarse.n_nodes)), inject(up.size());
  std::vector<std::uint8_t> done(down.size(), 0);
  for (const GridCell& cell : fine.cells)
    for (const Index node : cell.corner) {
      const auto n = static_cast<std::size_t>(node);
      if (done[n]++ != 0) continue;
      const GridCell& parent = coarse.cells[static_cast<std::size_t>(cell.parent)];
      GridPlace local{};
      for (std::size_t i = 0; i < 3; ++i) local[i] = fine.place[n][i] - 2 * parent.at[i];
      trilinear(local, parent, [&](Index to, float share) {
        auto& there = inject[static_cast<std::size_t>(to)];
        if (share == 1 && there.empty()) there.push_back({node, 1});
        if (fine.held[n] == 0 && coarse.held[static_cast<std::size_t>(to)] == 0)
          down[n].push_back({to, share});
      });
    }
  for (std::size_t n = 0; n < down.size(); ++n)
    for (const NodeShare& to : down[n])
      up[static_cast<std::size_t>(to.node)].push_back({static_cast<Index>(n), to.share});
  reach_beyond(fine, coarse, inject);
  for (std::size_t n = 0; n < up.size(); ++n)
    if (up[n].empty()) coarse.held[n] = 1;
  next.down = table_of(down);
  next.up = table_of(up);
  next.inject = table_of(inject);
  return next;
}

}  // namespace palpate::physics
