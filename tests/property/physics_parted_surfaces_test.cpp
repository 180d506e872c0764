// A surface of springs that a tool parts: what can be touched, seen and met of it, and what hangs together, is what its triangles
// say after every cut; a blade is felt as its toughness times the thickness of its wall.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/collision/contact_body.h"
#include "tests/support/physics/led_blade.h"
#include "tests/support/physics/mesh_worlds.h"
#include "tests/support/physics/parted_checks.h"

namespace palpate::physics::test {
namespace {

constexpr double toughness = 190, wall = 0.002;  // [J/m^2], [m]

/// A bag round a box of cells.
Recipe tough_bag(const std::array<int, 3>& cells = {6, 5, 4}, double edge = 0.005,
                 const std::string& keys = "", double jitter = 0.1) {
  Recipe recipe = mesh_box(cells, edge, "plain", jitter);
  const std::string elements = "elements = \"plain\"\n";
  recipe.shape.replace(recipe.shape.find(elements), elements.size(),
                       "model = \"surface\"\nthickness_mm = 2\n" + keys);
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 200\nviscosity_Pa_s = 10\ncut_toughness_J_per_m2 = 190";
  return recipe;
}

std::unique_ptr<BodyModel> model_to_part(const Recipe& recipe) {
  const Scene scene = scene_of(recipe);
  Body body = build_body(scene.bodies.at(0), scene.materials);
  make_ready_for_cuts(scene.bodies.at(0), scene.materials, body);
  return make_body_model(std::move(body), Precision::double_);
}

const TriangleNet& net_of(const BodyModel& body) { return *body.body().mesh->triangles; }

std::vector<EdgeGone> edges_of(const TriangleNet& net, unsigned seed) {
  std::vector<EdgeGone> all;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t side = 0; side < 3; ++side)
      if (net.beyond(t, side) > t) all.push_back({t, net.beyond(t, side)});
  std::ranges::shuffle(all, std::mt19937(seed));
  return all;
}

Faces triangles_of(const TriangleNet& net) {
  Faces faces;
  for (Index t = 0; t < net.n_elements(); ++t) faces.insert(turned(net.corners(t)));
  return faces;
}
/// V - E + F of a surface whose nodes are those of its fans, its loops of free edges, and its pieces.
struct Topology2 {
  int chi = 0, loops = 0, pieces = 0;
  bool is_manifold = true;
};
Topology2 topology_of(const TriangleNet& net) {
  std::map<std::pair<Index, Index>, int> sides;  // directed
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t s = 0; s < 3; ++s) ++sides[{net.face(t, s)[0], net.face(t, s)[1]}];
  Topology2 found;
  int edges = 0;
  std::map<Index, Index> onward;  // along a border
  for (const auto& [side, n] : sides) {
    found.is_manifold = found.is_manifold && n == 1;
    const bool is_free = !sides.contains({side.second, side.first});
    edges += is_free ? 2 : 1;
    if (is_free) found.is_manifold = onward.emplace(side.second, side.first).second && found.is_manifold;
  }
  std::set<Index> seen;
  for (const auto& [from, to] : onward) {
    if (seen.contains(from)) continue;
    ++found.loops;
    for (Index at = from; seen.insert(at).second;) at = onward.at(at);
  }
  std::set<Index> reached;
  for (Index t = 0; t < net.n_elements(); ++t) {
    if (!reached.insert(t).second) continue;
    ++found.pieces;
    std::vector<Index> open{t};
    while (!open.empty()) {
      const Index at = open.back();
      open.pop_back();
      for (std::size_t s = 0; s < 3; ++s)
        if (!net.is_open(at, s) && reached.insert(net.beyond(at, s)).second)
          open.push_back(net.beyond(at, s));
    }
  }
  found.chi = net.n_nodes() - edges / 2 + net.n_elements();
  return found;
}

class PartedSurface : public testing::Test {
 protected:
  template <class Look>
  void part(int cuts, const Look& look) {
    test::part(*moving, edges_of(net_of(*moving), 3), cuts, {.dt = 1e-6}, look);
  }
  std::unique_ptr<BodyModel> moving = model_to_part(tough_bag());
};

TEST_F(PartedSurface, IsTouchedSeenAndMetAtTheTrianglesThatItHas) {
  expect_known_by_its_faces(*moving, edges_of(net_of(*moving), 3), 20, {.dt = 1e-6},
                            [&] { return triangles_of(net_of(*moving)); });
}

/// Euler: of as many pieces without handles, with loops of free edges.
TEST_F(PartedSurface, StaysASurface) {
  part(60, [&] {
    const Topology2 now = topology_of(net_of(*moving));
    ASSERT_TRUE(now.is_manifold);
    ASSERT_EQ(now.chi, 2 * now.pieces - now.loops);
  });
}

TEST_F(PartedSurface, HangsTogetherAsAFloodOverAllSays) {
  Fragments followed(*moving);
  int most = 1;
  part(60, [&] { most = std::max(most, expect_to_hang_together(*moving, followed)); });
  EXPECT_EQ(most, net_of(*moving).n_elements()) << "crumbs in the end";
}

TEST_F(PartedSurface, GoesBackToWhereItWasParted) {
  const std::vector<EdgeGone> edges = edges_of(net_of(*moving), 5);
  expect_to_go_back(*moving, std::span(edges).first(200));
}

/// With a blade that stands upright in its upper wall, or beside it.
Recipe with_scalpel(Recipe recipe, double length_mm = 12) {
  recipe.physics = "frame_Hz = 1000";
  recipe.world = fmt::format(
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = {}\n"
      "device = \"hand\"\nstiffness_N_per_m = 1000\nedge_deg = 0\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 60, 0, 0], [1, 50, 0, 0]]\n",
      length_mm);
  return recipe;
}

struct Wall {
  double edge;         // of its triangles [m]
  double speed;        // [m/s]
  double modulus_kPa;  // Gc / E is a fifth of an edge, or the last a tenth
};
class CutWall : public testing::TestWithParam<Wall> {};

/// Gc t, whatever the triangles; what the hand has paid is Gc times the wall that has been opened.
TEST_P(CutWall, FeelsToughnessTimesThickness) {
  const auto [edge, speed, modulus] = GetParam();
  const auto cells = [edge = edge](double size) { return static_cast<int>(std::lround(size / edge)); };
  Recipe recipe = tough_bag({cells(0.04), cells(0.03), cells(0.02)}, edge);
  recipe.material.replace(recipe.material.find("200"), 3, fmt::format("{}", modulus));
  recipe.body = "fixed = [\"-y\", \"+y\", \"-z\"]";
  LedBlade cut(with_scalpel(recipe), Vec3(0.014, 0.0003, 0.015));
  cut.along(Vec3(0.014, 0.0003, 0.004), 0.1);  // down into the wall above
  cut.along(Vec3(0.005, 0.0003, 0.004), speed);
  const LedBlade::Stroke steady = cut.stroke(Vec3(-0.014, 0.0003, 0.004), speed);
  EXPECT_NEAR(steady.force - steady.viscous, toughness * wall, 0.08 * toughness * wall);
  const TriangleNet& net = net_of(cut.world.body(0));
  const Topology2 now = topology_of(net);
  EXPECT_TRUE(now.is_manifold);
  EXPECT_EQ(now.pieces, 1);
  EXPECT_EQ(now.loops, 1) << "a slit";
  // The wall that it has passed, by the nodes at rest that have split; at either end it may have gone on by an edge.
  double low = 1, high = -1;
  cut.world.body(0).body().each_copy([&](Index node) {
    const double x = cut.world.body(0).body().rest_position(node).x();
    low = std::min(low, x), high = std::max(high, x);
  });
  EXPECT_GT(high - low, 0.012);
  EXPECT_NEAR(cut.book().cut_area(), (high - low + edge) * wall, edge * wall);
  const EnergyLedger ledger = cut.world.ledger();
  EXPECT_NEAR(ledger.cut, toughness * cut.book().cut_area(), 1e-9);
  EXPECT_LT(ledger.balance_error(), 1e-3);
  EXPECT_EQ(cut.world.report().restored, 0);
}

INSTANTIATE_TEST_SUITE_P(Walls, CutWall,
                         testing::Values(Wall{0.005, 0.05, 200}, Wall{0.0025, 0.05, 400},
                                         Wall{0.0025, 0.2, 400}, Wall{0.0025, 0.05, 800}));

/// Nearer to each other than the triangles are large.
TEST(PartedBag, BearsWithBothOfItsWallsWhatTheyTake) {
  Recipe recipe = tough_bag({16, 12, 1}, 0.0025);
  recipe.material.replace(recipe.material.find("200"), 3, "800");
  recipe.body = "fixed = [\"-y\", \"+y\"]";
  LedBlade cut(with_scalpel(recipe), Vec3(0.014, 0.0003, 0.015));
  cut.along(Vec3(0.014, 0.0003, -0.006), 0.1);
  cut.along(Vec3(0.005, 0.0003, -0.006), 0.05);
  const LedBlade::Stroke steady = cut.stroke(Vec3(-0.014, 0.0003, -0.006), 0.05);
  EXPECT_NEAR(steady.force - steady.viscous, 2 * toughness * wall, 0.1 * 2 * toughness * wall);
  EXPECT_NEAR(steady.opened, 2 * wall, 0.1 * 2 * wall);
  EXPECT_EQ(topology_of(net_of(cut.world.body(0))).loops, 2);
  EXPECT_LT(cut.world.ledger().balance_error(), 1e-3);
}

/// Right through, a third of its wall along the edge, of which it pays for half: it parts before all of its thickness
/// is behind.
TEST(PartedBag, IsPaidForAllTheWayRound) {
  Recipe recipe = tough_bag({12, 8, 6}, 0.0025);
  recipe.material.replace(recipe.material.find("200"), 3, "1600");
  recipe.body = "fixed = [\"-y\", \"+y\"]";
  LedBlade cut(with_scalpel(recipe, 40), Vec3(0.030, 0.0003, -0.020));
  cut.along(Vec3(-0.030, 0.0003, -0.020), 0.1);
  const double round = 2 * (0.030 + 0.015);
  EXPECT_GT(cut.book().cut_area(), 0.8 * round * wall);
  EXPECT_LT(cut.book().cut_area(), 1.02 * round * wall);
  const Topology2 now = topology_of(net_of(cut.world.body(0)));
  EXPECT_EQ(now.pieces, 2);
  EXPECT_EQ(now.loops, 2);
  EXPECT_LT(cut.world.ledger().balance_error(), 2e-3);
}

/// Cut all the way round, its lid comes off, and both pieces keep what they weigh.
TEST(PartedBag, LosesItsLid) {
  Recipe recipe = tough_bag({16, 12, 8}, 0.0025);
  recipe.material.replace(recipe.material.find("200"), 3, "800");
  recipe.body = "fixed = [\"-z\"]";
  recipe.world = "";
  auto moving = model_to_part(recipe);
  const TriangleNet& net = net_of(*moving);
  const auto height = [&](Index t) {
    double z = 0;
    for (const Index node : net.corners(t)) z += moving->body().rest_position(node).z() / 3;
    return z;
  };
  std::vector<EdgeGone> round;
  for (const EdgeGone& edge : edges_of(net, 1))
    if ((height(edge.a) > 0.004) != (height(edge.b) > 0.004)) round.push_back(edge);
  double mass = 0;
  moving->body().each_node([&](Index node) { mass += node_mass(moving->body(), node); });
  moving->advance({.dt = 1e-6}, {});
  EXPECT_EQ(moving->cut(round), static_cast<std::int64_t>(round.size()));
  const Topology2 now = topology_of(net);
  EXPECT_EQ(now.pieces, 2);
  EXPECT_EQ(now.loops, 2);
  EXPECT_EQ(now.chi, 2);
  Fragments pieces(*moving);
  EXPECT_EQ(pieces.count(), 2);
  double left = 0;
  for (const FragmentMeasure& piece : measure_fragments(*moving, pieces)) left += piece.mass;
  EXPECT_NEAR(left, mass, 1e-13 * mass);
}

/// A bag that is filled empties where it is opened, and the books say where that went.
TEST(PartedBag, EmptiesWhereItIsOpened) {
  Recipe recipe = tough_bag({8, 6, 4}, 0.005, "pressure_kPa = 1\ncontent_modulus_kPa = 20\n");
  recipe.body = "fixed = [\"-y\", \"+y\", \"-z\"]";
  const auto stroke = [](LedBlade& cut) {
    cut.along(Vec3(0.010, 0.0003, 0.004), 0.1), cut.along(Vec3(-0.010, 0.0003, 0.004), 0.1);
  };
  LedBlade cut(with_scalpel(recipe), Vec3(0.010, 0.0003, 0.020));
  const double broken = cut.world.ledger().broken;
  stroke(cut);
  EXPECT_GT(net_of(cut.world.body(0)).n_copies(), 3);
  EXPECT_NE(cut.world.ledger().broken, broken);
  EXPECT_LT(cut.world.ledger().balance_error(), 0.01);
  EXPECT_EQ(cut.world.report().restored, 0);
  const std::uint64_t first = cut.world.state_hash();
  cut.world.reset();
  EXPECT_EQ(net_of(cut.world.body(0)).n_copies(), 0);
  LedBlade again(with_scalpel(recipe), Vec3(0.010, 0.0003, 0.020));
  stroke(again);
  EXPECT_EQ(again.world.state_hash(), first);
}

TEST(PartedBag, NeedsToKnowHowToughItIs) {
  Recipe recipe = with_scalpel(tough_bag());
  const std::string tough = "\ncut_toughness_J_per_m2 = 190";
  recipe.material.erase(recipe.material.find(tough), tough.size());
  try {
    const World world(scene_of(recipe));
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("needs to know how tough \"body\" is"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace palpate::physics::test
