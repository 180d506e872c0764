// The next level of a hierarchy: it keeps what a body weighs and how stiff it is, follows every linear displacement, and leaves a slit
// open.

#include "physics_node/step/multigrid/coarsen.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "physics_node/step/multigrid/dense_cells.h"
#include "tests/support/physics/solid_bodies.h"

namespace palpate::physics {
namespace {

using test::solid_block;

Vec3 place_of(const GridLevel& level, Index node) {
  const GridPlace& at = level.place[static_cast<std::size_t>(node)];
  return level.edge.cwiseProduct(Vec3(at[0], at[1], at[2]));
}
double linear(const Vec3& x) { return 0.3 + x.dot(Vec3(1, -2, 0.7)); }

double of_shares(std::span<const NodeShare> shares, const GridLevel& level) {
  double sum = 0;
  for (const NodeShare& share : shares)
    sum += static_cast<double>(share.share) * linear(place_of(level, share.node));
  return sum;
}

template <class Visit>
void for_nodes(const GridLevel& level, const Visit& visit) {
  for (const GridPlane& plane : level.planes)
    for (Index n = plane.first; n < plane.last; ++n) visit(n);
}

TEST(Coarsen, FollowsLinearDisplacementsAndKeepsStiffness) {
  BodyGrid grid = body_grid(solid_block({.cells = 11, .held = ""}, [](int i, int j, int k) {
    return test::in_blob(Vec3(i + 0.5, j + 0.5, k + 0.5) / 11) * (1 + i);
  }));
  GridLevel fine = grid.level;
  for (int n = 0; n < 3; ++n) {
    const CoarserLevel next = coarsen(fine);
    double before = 0, after = 0;
    for (const GridCell& cell : fine.cells) before += cell.stiffness;
    for (const GridCell& cell : next.level.cells) after += 8 * cell.stiffness;
    EXPECT_NEAR(after, before, 1e-12 * before);
    EXPECT_LT(next.level.cells.size(), fine.cells.size() / 3);
    for_nodes(fine, [&](Index node) {
      EXPECT_NEAR(of_shares(next.down.of(node), next.level), linear(place_of(fine, node)), 1e-6);
    });
    for_nodes(next.level, [&](Index node) {
      EXPECT_NEAR(of_shares(next.inject.of(node), fine), linear(place_of(next.level, node)), 1e-6);
    });
    fine = next.level;
  }
}

TEST(Coarsen, ASumOfForcesStaysTheSame) {
  BodyGrid grid = body_grid(solid_block({.cells = 9}));
  const CoarserLevel next = coarsen(grid.level);
  double there = 0, back = 0;
  for_nodes(grid.level, [&](Index node) {
    for (const NodeShare& share : next.down.of(node))
      there += static_cast<double>(share.share) * (1 + node % 7);
  });
  for_nodes(next.level, [&](Index node) {
    for (const NodeShare& share : next.up.of(node))
      back += static_cast<double>(share.share) * (1 + share.node % 7);
  });
  EXPECT_NEAR(there, back, 1e-9 * there);
}

/// Which nodes can be reached from the first, through cells.
std::size_t largest_part(const GridLevel& level) {
  std::map<Index, Index> parent;
  const std::function<Index(Index)> find = [&](Index n) {
    return parent.emplace(n, n).first->second == n ? n : parent[n] = find(parent[n]);
  };
  for (const GridCell& cell : level.cells)
    for (const Index node : cell.corner) parent[find(node)] = find(cell.corner[0]);
  std::set<Index> roots;
  for (const auto& [node, of] : parent) roots.insert(find(node));
  return roots.size();
}

// Two halves one cell apart. Without copies the coarse cells of both would share corners from the first level on.
TEST(Coarsen, HalvesThatDoNotTouchDoNotTouchOnAnyLevel) {
  for (const int slit : {7, 8}) {
    GridLevel level = body_grid(solid_block({.cells = 16}, [slit](int i, int, int) {
                        return i == slit ? 0.0 : 1.0;
                      })).level;
    EXPECT_EQ(largest_part(level), 2u);
    for (int n = 0; n < 4; ++n) {
      level = coarsen(level).level;
      EXPECT_EQ(largest_part(level), 2u) << "slit at " << slit << ", level " << n + 1;
    }
    EXPECT_EQ(level.cells.size(), 2u);  // at one place
    EXPECT_EQ(level.cells[0].at, level.cells[1].at);
  }
}

// A slit that ends: the two sides have nodes of their own where it is open, and share them where it is not.
TEST(Coarsen, ASlitOpensWhereItBegins) {
  GridLevel fine = body_grid(solid_block({.cells = 16}, [](int i, int, int k) {
                     return i == 8 && k >= 8 ? 0.0 : 1.0;
                   })).level;
  const GridLevel coarse = coarsen(fine).level;
  EXPECT_EQ(largest_part(coarse), 1u);
  std::map<GridPlace, int> copies;
  for_nodes(coarse, [&](Index node) { ++copies[coarse.place[static_cast<std::size_t>(node)]]; });
  for (const auto& [at, count] : copies)
    EXPECT_EQ(count, at[0] == 4 && at[2] > 4 ? 2 : 1) << at[0] << ' ' << at[1] << ' ' << at[2];
}

TEST(Coarsen, CellsBetweenWhatIsHeldAndWhatIsNotHaveTheStiffnessOfTheirParts) {
  // The bottom lies on the coarse lattice; a second layer that is held does not.
  for (const int layers : {1, 2}) {
    GridLevel fine = body_grid(solid_block({.cells = 8})).level;
    for_nodes(fine, [&](Index node) {
      const bool held = fine.place[static_cast<std::size_t>(node)][2] < layers;
      fine.held[static_cast<std::size_t>(node)] = held ? 1 : 0;
    });
    const GridLevel coarse = coarsen(fine).level;
    for_nodes(coarse, [&](Index node) {
      EXPECT_EQ(coarse.held[static_cast<std::size_t>(node)] != 0,
                coarse.place[static_cast<std::size_t>(node)][2] == 0);
    });
    const HexMatrix unit = hex_stiffness({.modulus = 1, .poisson_ratio = 0.3}, fine.edge);
    const auto dense = dense_cells(fine, {}, unit, coarse);
    EXPECT_EQ(dense.size(), layers == 1 ? 0u : 16u);
    for (const DenseCell& cell : dense) {
      EXPECT_EQ(coarse.cells[static_cast<std::size_t>(cell.cell)].at[2], 0);
      EXPECT_LT((cell.stiffness - cell.stiffness.transpose()).norm(), 1e-12 * cell.stiffness.norm());
    }
  }
}

}  // namespace
}  // namespace palpate::physics
