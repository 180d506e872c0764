// How cells part along their faces: every component of cells round a node has one node, and no two have the same.

#include "physics_node/lattice/cell_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "common/scene/scene.h"
#include "physics_node/body/body.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

Body block(int n, const std::string& shape = {}) {
  test::Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = shape.empty() ? test::Recipe::box(n, n, n) : shape;
  recipe.spacing_mm = 1;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.body = "model = \"fem\"";
  return test::body_of(recipe);
}

struct Net {
  explicit Net(const Body& of, std::size_t copies = 1 << 20)
      : body(of), net(of.lattice, of.solid->stiffness, copies) {}
  Vec3 centre(Index cell) const { return body.lattice.rest_position(cell) + 0.5 * body.lattice.step; }
  /// Opens all faces between cells whose centres lie on both sides, where `hit` allows.
  int open_between(const std::function<bool(const Vec3&)>& above,
                   const std::function<bool(const Vec3&)>& hit) {
    int opened = 0;
    for (const Index cell : net.cells())
      for (std::size_t f = 1; f < CellNet::n_faces; f += 2) {
        const Index other = net.beyond(cell, f);
        if (other == CellNet::none || above(centre(cell)) == above(centre(other))) continue;
        if (hit(0.5 * (centre(cell) + centre(other)))) opened += net.open(cell, other) ? 1 : 0;
      }
    return opened;
  }
  int pieces() const {
    std::map<Index, Index> root;
    for (const Index cell : net.cells()) root[cell] = cell;
    const std::function<Index(Index)> find = [&](Index c) {
      return root[c] == c ? c : root[c] = find(root[c]);
    };
    for (const Index cell : net.cells())
      for (std::size_t f = 1; f < CellNet::n_faces; f += 2)
        if (const Index other = net.beyond(cell, f); other != CellNet::none && !net.is_open(cell, f))
          root[find(cell)] = find(other);
    std::set<Index> roots;
    for (const Index cell : net.cells()) roots.insert(find(cell));
    return static_cast<int>(roots.size());
  }

  const Body& body;
  CellNet net;
};

/// By its definition, from the open faces alone.
void expect_a_node_for_each_fan(const Net& of) {
  const CellNet& net = of.net;
  std::set<Index> used;
  std::set<Index> loaded;
  for (const Index cell : net.cells())
    for (const Index node : net.loaded_corners(cell)) loaded.insert(node);
  for (const Index node : loaded) {
    std::map<std::size_t, Index> at;  // by octant
    net.each_around(node, [&](Index cell, std::size_t corner) { at[7 - corner] = cell; });
    std::map<std::size_t, std::size_t> fan;
    for (const auto& [o, cell] : at) fan[o] = o;
    for (std::size_t round = 0; round < 8; ++round)
      for (const auto& [o, cell] : at)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::size_t beside = o ^ std::size_t{1} << axis;
          if (!at.contains(beside) || net.is_open(cell, 2 * axis + ((o >> axis & 1) != 0 ? 0 : 1))) continue;
          fan[o] = fan[beside] = std::min(fan[o], fan[beside]);
        }
    std::map<std::size_t, Index> node_of_fan;
    for (const auto& [o, cell] : at) {
      const Index has = net.corners(cell)[7 - o];
      EXPECT_EQ(net.origin(has), node);
      const auto [known, is_new] = node_of_fan.emplace(fan[o], has);
      EXPECT_EQ(known->second, has);
      if (is_new) {
        EXPECT_TRUE(used.insert(has).second) << "two fans with one node";
      }
    }
    EXPECT_TRUE(used.contains(node)) << "nobody has the node as loaded";
    EXPECT_EQ(net.has_split(node), node_of_fan.size() > 1);
  }
  EXPECT_EQ(static_cast<Index>(used.size() - loaded.size()), net.n_copies()) << "an orphan";
}

bool everywhere(const Vec3&) { return true; }

TEST(CellNet, PartsAlongAPlane) {
  const Body body = block(20);
  Net net(body);
  EXPECT_EQ(net.open_between([](const Vec3& p) { return p.x() > 0; }, everywhere), 400);
  EXPECT_EQ(net.net.n_copies(), 441);
  EXPECT_EQ(net.net.n_open(), 400);
  EXPECT_EQ(net.pieces(), 2);
  EXPECT_EQ(net.net.parted().size(), 400U) << "those on the side that has the copies";
  expect_a_node_for_each_fan(net);
}

TEST(CellNet, SharesTheNodesAtTheEndOfACrack) {
  const Body body = block(20);
  Net net(body);
  EXPECT_EQ(
      net.open_between([](const Vec3& p) { return p.x() > 0; }, [](const Vec3& p) { return p.y() > 0; }),
      200);
  EXPECT_EQ(net.net.n_copies(), 210) << "21 nodes at the end of the crack stay whole";
  EXPECT_EQ(net.pieces(), 1);
  expect_a_node_for_each_fan(net);
}

TEST(CellNet, CrossesItself) {
  const Body body = block(20);
  Net net(body);
  net.open_between([](const Vec3& p) { return p.x() > 0; }, everywhere);
  net.open_between([](const Vec3& p) { return p.y() > 0; }, everywhere);
  EXPECT_EQ(net.net.n_copies(), 441 + 441 + 21);
  EXPECT_EQ(net.pieces(), 4);
  expect_a_node_for_each_fan(net);
}

TEST(CellNet, OpensNothingByOneFaceInside) {
  const Body body = block(6);
  Net net(body);
  const Index cell = net.net.cells()[net.net.cells().size() / 2], other = net.net.beyond(cell, 1);
  ASSERT_NE(other, CellNet::none);
  EXPECT_TRUE(net.net.open(cell, other));
  EXPECT_FALSE(net.net.open(cell, other)) << "again";
  EXPECT_FALSE(net.net.open(other, cell)) << "from the other side";
  EXPECT_FALSE(net.net.open(cell, cell));
  EXPECT_FALSE(net.net.open(-1, cell));
  EXPECT_FALSE(net.net.open(body.capacity(), cell));
  EXPECT_EQ(net.net.n_copies(), 0);
  EXPECT_FALSE(net.net.is_exposed(cell, 1));
}

/// Faces at random, until all cells are crumbs; and then all joined again.
TEST(CellNet, GivesEachFanOneNodeWhateverIsCut) {
  const Body body = block(9, test::Recipe::sphere(4.5));
  Net net(body);
  std::vector<std::pair<Index, Index>> faces;
  for (const Index cell : net.net.cells())
    for (std::size_t f = 1; f < CellNet::n_faces; f += 2)
      if (const Index other = net.net.beyond(cell, f); other != CellNet::none)
        faces.emplace_back(cell, other);
  std::mt19937 dice(7);
  std::shuffle(faces.begin(), faces.end(), dice);
  std::size_t n = 0;
  for (const auto& [a, b] : faces) {
    EXPECT_TRUE(net.net.open(a, b));
    if (++n % (faces.size() / 12) == 0) expect_a_node_for_each_fan(net);
  }
  EXPECT_EQ(net.pieces(), static_cast<int>(net.net.cells().size()));
  EXPECT_EQ(static_cast<std::size_t>(net.net.n_copies()), 8 * net.net.cells().size() - body.nodes().size());
  int joined = 0;
  net.net.reset([&](Index) { ++joined; });
  EXPECT_EQ(static_cast<std::size_t>(joined), 8 * net.net.cells().size() - body.nodes().size());
  EXPECT_EQ(net.net.n_copies(), 0);
  EXPECT_EQ(net.pieces(), 1);
  expect_a_node_for_each_fan(net);
}

TEST(CellNet, LeavesOutWhatItHasNoRoomFor) {
  const Body body = block(6);
  Net net(body, 10);
  const int opened = net.open_between([](const Vec3& p) { return p.x() > 0; }, everywhere);
  EXPECT_LT(opened, 36);
  EXPECT_EQ(net.net.left_out(), static_cast<std::uint64_t>(36 - opened));
  EXPECT_LE(net.net.n_copies(), 10);
  expect_a_node_for_each_fan(net);
}

TEST(CellNet, HasFacesThatLookOutwards) {
  const Body body = block(3);
  const Net net(body);
  for (const Index cell : net.net.cells())
    for (std::size_t f = 0; f < CellNet::n_faces; ++f) {
      const CellNet::Face face = net.net.face(cell, f);
      const auto at = [&](std::size_t k) { return body.lattice.rest_position(face[k]); };
      const Vec3 area = 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
      Vec3 outward = Vec3::Zero();
      outward[static_cast<Eigen::Index>(f / 2)] = f % 2 == 0 ? -1e-6 : 1e-6;
      EXPECT_LT((area - outward).norm(), 1e-12);
      if (const Index other = net.net.beyond(cell, f); other != CellNet::none) {
        EXPECT_LT((net.centre(other) - net.centre(cell) - 1e3 * outward).norm(), 1e-12);
        EXPECT_EQ(net.net.beyond(other, f ^ 1U), cell);
      }
    }
}

}  // namespace
}  // namespace palpate::physics
