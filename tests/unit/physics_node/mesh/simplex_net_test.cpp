// A mesh that comes apart along its faces: what is closed stays closed, what hangs together is what joined faces connect,
// whatever the order in which they were opened.

#include "physics_node/mesh/simplex_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>

#include "physics_node/mesh/tet_box.h"

namespace palpate::physics {
namespace {

constexpr std::size_t plenty = 100000;

TetMesh box(std::array<int, 3> cells = {6, 5, 4}) {
  return make_tet_box({.cells = cells, .edge = 1, .jitter = 0.15});
}

Vec3 centre_of(const TetMesh& mesh, Index tet) {
  Vec3 sum = Vec3::Zero();
  for (const Index node : mesh.tets[static_cast<std::size_t>(tet)])
    sum += mesh.nodes[static_cast<std::size_t>(node)];
  return sum / 4;
}

using Pair = std::pair<Index, Index>;
/// Tetrahedra with a common face, on both sides of something.
std::vector<Pair> pairs_across(const TetMesh& mesh, const TetNet& net,
                               const std::function<bool(const Vec3&)>& above) {
  std::vector<Pair> pairs;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t f = 0; f < 4; ++f)
      if (const Index u = net.beyond(t, f); u > t && above(centre_of(mesh, t)) != above(centre_of(mesh, u)))
        pairs.emplace_back(t, u);
  return pairs;
}

struct Skin {
  std::map<Pair, int> edges;  // directed
  std::set<Index> vertices;
  int faces = 0;
};
Skin skin_of(const TetNet& net) {
  Skin skin;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      if (!net.is_exposed(t, f)) continue;
      ++skin.faces;
      const MeshTriangle face = net.face(t, f);
      for (std::size_t k = 0; k < 3; ++k) {
        ++skin.edges[{face[k], face[(k + 1) % 3]}];
        skin.vertices.insert(face[k]);
      }
    }
  return skin;
}
/// Every directed edge as often as its opposite.
bool is_closed(const Skin& skin) {
  return std::ranges::all_of(skin.edges, [&](const auto& edge) {
    const auto back = skin.edges.find({edge.first.second, edge.first.first});
    return back != skin.edges.end() && back->second == edge.second;
  });
}
/// Every edge of two faces alone: no two sheets of it meet along a line.
bool is_simple(const Skin& skin) {
  return std::ranges::all_of(skin.edges, [](const auto& edge) { return edge.second == 1; });
}
int euler(const Skin& skin) {
  return static_cast<int>(skin.vertices.size()) - static_cast<int>(skin.edges.size()) / 2 + skin.faces;
}

/// By tetrahedra that share a node.
int pieces_of(const TetNet& net) {
  std::vector<Index> root(static_cast<std::size_t>(net.n_nodes()));
  std::iota(root.begin(), root.end(), 0);
  const std::function<Index(Index)> find = [&](Index n) {
    return root[static_cast<std::size_t>(n)] == n ? n : find(root[static_cast<std::size_t>(n)]);
  };
  std::set<Index> used;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (const Index node : net.corners(t)) {
      root[static_cast<std::size_t>(find(node))] = find(net.corners(t)[0]);
      used.insert(node);
    }
  std::set<Index> roots;
  for (const Index node : used) roots.insert(find(node));
  return static_cast<int>(roots.size());
}

/// Which corners are one node, whatever that is called.
std::vector<std::size_t> classes_of(const TetNet& net) {
  std::map<Index, std::size_t> first;
  std::vector<std::size_t> classes;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (const Index node : net.corners(t))
      classes.push_back(first.try_emplace(node, classes.size()).first->second);
  return classes;
}

TEST(TetNet, BeginsWithTheSkinOfTheMesh) {
  const TetMesh mesh = box();
  const TetNet net(mesh.tets, mesh.nodes.size(), plenty);
  const Skin skin = skin_of(net);
  EXPECT_EQ(skin.faces, static_cast<int>(outer_faces(mesh).triangles.size()));
  EXPECT_TRUE(is_closed(skin));
  EXPECT_EQ(euler(skin), 2);
  EXPECT_EQ(pieces_of(net), 1);
  for (Index n = 0; n < net.n_nodes(); ++n) EXPECT_EQ(net.is_exposed(n), skin.vertices.contains(n));
}

TEST(TetNet, OpensNothingByOneFaceAlone) {
  const TetMesh mesh = box();
  TetNet net(mesh.tets, mesh.nodes.size(), plenty);
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      if (net.beyond(t, f) == TetNet::none) continue;
      const MeshTriangle face = net.face(t, f);
      if (std::ranges::any_of(face, [&](Index n) { return net.is_exposed(n); })) continue;
      net.reset();
      net.begin();
      ASSERT_TRUE(net.open(t, net.beyond(t, f)));
      ASSERT_FALSE(net.open(t, net.beyond(t, f))) << "twice";
      ASSERT_EQ(net.n_copies(), 0);
      ASSERT_FALSE(net.is_exposed(t, f));
    }
}

TEST(TetNet, PartsABoxByAPlane) {
  const TetMesh mesh = box();
  TetNet net(mesh.tets, mesh.nodes.size(), plenty);
  for (const auto& [t, u] :
       pairs_across(mesh, net, [](const Vec3& x) { return x.dot(Vec3(1, 0.3, 0.2)) > 4; }))
    ASSERT_TRUE(net.open(t, u));
  const Skin skin = skin_of(net);
  EXPECT_EQ(pieces_of(net), 2);
  EXPECT_TRUE(is_closed(skin));
  EXPECT_TRUE(is_simple(skin));
  EXPECT_EQ(euler(skin), 4) << "two balls";
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_EQ(net.origin(net.corners(t)[c]), mesh.tets[static_cast<std::size_t>(t)][c]);
}

TEST(TetNet, LeavesWhatIsCutHalfWayInOnePiece) {
  const TetMesh mesh = box();
  TetNet net(mesh.tets, mesh.nodes.size(), plenty);
  const auto right = [](const Vec3& x) { return x.x() > 3; };
  for (const auto& [t, u] : pairs_across(mesh, net, right))
    if (centre_of(mesh, t).y() < 2.5) net.open(t, u);
  const Skin skin = skin_of(net);
  EXPECT_EQ(pieces_of(net), 1);
  EXPECT_GT(net.n_copies(), 0);
  EXPECT_TRUE(is_closed(skin));
  EXPECT_EQ(euler(skin), 2) << "a ball with a notch";
}

TEST(TetNet, CutsOutWhatABallHolds) {
  const TetMesh mesh = box({8, 8, 8});
  TetNet net(mesh.tets, mesh.nodes.size(), plenty);
  for (const auto& [t, u] :
       pairs_across(mesh, net, [](const Vec3& x) { return (x - Vec3(4, 4, 4)).norm() < 2.4; }))
    net.open(t, u);
  EXPECT_EQ(pieces_of(net), 2);
  EXPECT_TRUE(is_closed(skin_of(net)));
}

/// At random faces until none is left, and the same once more in another order.
TEST(TetNet, EndsWithEveryTetrahedronAloneWhateverTheOrder) {
  const TetMesh mesh = box({4, 3, 3});
  TetNet net(mesh.tets, mesh.nodes.size(), plenty);
  std::vector<Pair> all;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t f = 0; f < 4; ++f)
      if (net.beyond(t, f) > t) all.emplace_back(t, net.beyond(t, f));
  std::vector<std::vector<std::size_t>> half;
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::vector<Pair> some(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2));
    std::shuffle(some.begin(), some.end(), std::mt19937(seed));
    net.reset();
    for (const auto& [t, u] : some) {
      net.open(t, u);
      ASSERT_TRUE(is_closed(skin_of(net)));
    }
    half.push_back(classes_of(net));
  }
  EXPECT_EQ(half[0], half[1]);
  EXPECT_EQ(half[0], half[2]);
  for (const auto& [t, u] : all) net.open(t, u);
  EXPECT_EQ(net.n_nodes(), 4 * net.n_elements());
  EXPECT_EQ(pieces_of(net), net.n_elements());
  net.reset();
  EXPECT_EQ(net.n_copies(), 0);
  EXPECT_EQ(euler(skin_of(net)), 2);
}

TEST(TetNet, TellsWhatSplitInTheOrderInWhichItDid) {
  const TetMesh mesh = box();
  TetNet net(mesh.tets, mesh.nodes.size(), plenty);
  const auto pairs = pairs_across(mesh, net, [](const Vec3& x) { return x.x() > 3; });
  Index next = net.n_loaded();
  std::size_t told = 0;
  for (const auto& [t, u] : pairs) {
    net.begin();
    net.open(t, u);
    for (const NodeSplit& split : net.splits()) {
      EXPECT_LT(split.node, split.copy);
      EXPECT_EQ(split.copy, next++);
      EXPECT_TRUE(net.has_split(split.node) && net.has_split(split.copy));
      EXPECT_EQ(net.origin(split.copy), net.origin(split.node));
    }
    told += net.splits().size();
  }
  EXPECT_EQ(static_cast<Index>(told), net.n_copies());
}

TEST(TetNet, KeepsAFaceJoinedThatItHasNoRoomToOpen) {
  const TetMesh mesh = box();
  TetNet net(mesh.tets, mesh.nodes.size(), 10);
  for (const auto& [t, u] : pairs_across(mesh, net, [](const Vec3& x) { return x.x() > 3; })) net.open(t, u);
  EXPECT_GT(net.left_out(), 0U);
  EXPECT_LE(net.n_copies(), 10);
  EXPECT_TRUE(is_closed(skin_of(net)));
}

}  // namespace
}  // namespace palpate::physics
