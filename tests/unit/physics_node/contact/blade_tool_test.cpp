// A scalpel in springs: what it feels is toughness times length whatever the lattice, what it passes parts, nothing is lost.

#include "physics_node/contact/blade_tool.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "common/error/error.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/led_blade.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double toughness = 190, thick = 0.010, wide = 0.030;  // of the block, along the edge and the cut
constexpr double plane = 0.0003;                                // of the blade: y, through no mass [m]

struct Case {
  const char* lattice;
  double spacing_mm, speed;  // [m/s]
};

Recipe block(const Case& c, const std::string& keys = "edge_deg = 0", double stiffness = 1000) {
  Recipe recipe;
  recipe.lattice = c.lattice;
  recipe.shape = Recipe::box(1e3 * wide, 16, 1e3 * thick);
  recipe.spacing_mm = c.spacing_mm;
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 400\nviscosity_Pa_s = 20\n"
      "cut_toughness_J_per_m2 = 190";
  recipe.body = "fixed = [\"-y\", \"+y\"]";
  recipe.physics = "frame_Hz = 1000";
  recipe.world = fmt::format(
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 20\ndevice = \"hand\"\n"
      "stiffness_N_per_m = {}\n{}\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 30, 0, 0], [1, 20, 0, 0]]\n",
      stiffness, keys);
  return recipe;
}

struct Cut : LedBlade {
  explicit Cut(const Recipe& recipe) : LedBlade(recipe, Vec3(0.020, plane, -0.010)) {}
  Eigen::AlignedBox3d masses() const {
    Eigen::AlignedBox3d box;
    for (const Index node : world.body(0).body().nodes())
      box.extend(world.body(0).body().rest_position(node));
    return box;
  }
  /// Live elements whose ends lie on both sides of the blade's plane at rest.
  int across() const {
    const BodyModel& body = world.body(0);
    int n = 0;
    for (const Index a : body.body().nodes())
      body.adjacency().each_neighbour(a, [&](Index b) {
        n +=
            a < b && (body.body().rest_position(a).y() < plane) != (body.body().rest_position(b).y() < plane);
      });
    return n;
  }
  /// How many masses hang together, of each piece, the largest first.
  std::vector<int> pieces() const {
    const BodyModel& body = world.body(0);
    std::vector<bool> seen(static_cast<std::size_t>(body.body().capacity()));
    std::vector<int> sizes;
    for (const Index root : body.body().nodes()) {
      std::vector<Index> open;
      const auto reach = [&](Index node) {
        if (seen[static_cast<std::size_t>(node)]) return;
        seen[static_cast<std::size_t>(node)] = true;
        open.push_back(node);
      };
      reach(root);
      if (open.empty()) continue;
      sizes.push_back(0);
      for (; !open.empty(); ++sizes.back()) {
        const Index node = open.back();
        open.pop_back();
        body.adjacency().each_neighbour(node, reach);
      }
    }
    std::ranges::sort(sizes, std::greater());
    return sizes;
  }
};

class Scalpel : public testing::TestWithParam<Case> {};

TEST_P(Scalpel, FeelsToughnessTimesLengthAndPaysForTheAreaThatItOpens) {
  const Case c = GetParam();
  Cut cut(block(c));
  const int before = cut.across();
  const Eigen::AlignedBox3d box = cut.masses();
  const double thickness = box.max().z() - box.min().z(), width = box.max().x() - box.min().x();
  const double begin = 0.020, end = -0.035, from = begin + 0.45 * (end - begin),
               to = begin + 0.65 * (end - begin);
  std::vector<Vec3> forces = cut.along(Vec3(from, plane, -0.010), c.speed);
  // While all of the thickness is before the edge.
  const LedBlade::Stroke steady = cut.stroke(Vec3(to, plane, -0.010), c.speed);
  EXPECT_NEAR(steady.opened, thickness, 0.03 * thickness);
  // What tissue's own viscosity takes as it is pushed aside is felt, too.
  EXPECT_LT(steady.viscous, 0.1 * toughness * thickness);
  EXPECT_NEAR(steady.force - steady.viscous, toughness * thickness, 0.03 * toughness * thickness);
  EXPECT_LT(steady.jump, 0.03 * toughness * thickness) << "of a frame";

  cut.along(Vec3(end, plane, -0.010), c.speed);
  // No strands: what was one body is two, and no crumbs have come off. A mass beside the plane may have gone to the other lip.
  const std::vector<int> pieces = cut.pieces();
  EXPECT_EQ(pieces.size(), 2U);
  EXPECT_GT(pieces.back(), 0.7 * pieces.front());
  EXPECT_LE(cut.across(), 0.02 * before);
  EXPECT_NEAR(cut.book().cut_area(), width * thickness, 0.04 * width * thickness);
  const EnergyLedger ledger = cut.world.ledger();
  EXPECT_NEAR(ledger.cut, toughness * cut.book().cut_area(), 1e-9);
  EXPECT_GE(ledger.broken, 0);
  EXPECT_LT(ledger.balance_error(), 1e-3);
  EXPECT_EQ(cut.world.report().restored, 0);
}

INSTANTIATE_TEST_SUITE_P(Lattices, Scalpel,
                         testing::Values(Case{"voxel", 2, 0.05}, Case{"voxel", 2, 0.2}, Case{"voxel", 1, 0.1},
                                         Case{"fcc", 2, 0.05}, Case{"fcc", 1.2, 0.1}),
                         [](const testing::TestParamInfo<Case>& one) {
                           return fmt::format("{}{}", one.param.lattice, one.index);
                         });

/// A blade in a plane of masses, as symmetry makes it: each goes to one lip, and the area is that of the plane.
TEST(BladeTool, OpensAPlaneOfMassesAlike) {
  Cut cut(block({"voxel", 2, 0}));
  cut.path = {Vec3(0.020, 0, -0.010), Vec3(0.020, 0, -0.010)};
  const Vec3 size = cut.masses().sizes();
  cut.along(Vec3(-0.035, 0, -0.010), 0.05);
  EXPECT_NEAR(cut.book().cut_area(), size.x() * size.z(), 0.04 * size.x() * size.z());
  EXPECT_EQ(cut.pieces().size(), 2U);
}

TEST(BladeTool, DoesNotPullBackAndFeelsNothingInItsOwnSlot) {
  Cut cut(block({"voxel", 2, 0}));
  cut.along(Vec3(0, plane, -0.010), 0.05);
  const double opened = cut.book().cut_area();
  EXPECT_GT(opened, 0.3 * wide * thick);
  for (const Vec3& force : cut.along(Vec3(0.020, plane, -0.010), 0.05)) EXPECT_GT(force.x(), -0.02);
  const std::vector<Vec3> again = cut.along(Vec3(0.008, plane, -0.010), 0.05);
  for (const Vec3& force : again) EXPECT_LT(force.norm(), 0.1);
  EXPECT_NEAR(cut.book().cut_area(), opened, 0.02 * wide * thick);
}

TEST(BladeTool, StabsByItsObliqueEdge) {
  Cut cut(block({"voxel", 2, 0}, "edge_deg = 30"));
  cut.path = {Vec3(0, plane, 0.008), Vec3(0, plane, 0.008)};
  const std::vector<Vec3> forces = cut.along(Vec3(0, plane, -0.001), 0.02);
  EXPECT_GT(forces.back().z(), 0.1) << "out of the tissue";
  EXPECT_GT(cut.book().cut_area(), 0);
}

TEST(BladeTool, CutsTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    Recipe recipe = block({"voxel", 1, 0});
    recipe.physics += fmt::format("\nthreads = {}", threads);
    Cut cut(recipe);
    cut.along(Vec3(0.005, plane, -0.010), 0.2);
    EXPECT_GT(cut.book().cut_area(), 0);
    hashes.push_back(cut.world.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

std::string refusal(const Recipe& recipe) {
  try {
    World world(scene_of(recipe));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BladeTool, SaysWhatItCannotCut) {
  Recipe untold = block({"voxel", 2, 0});
  untold.material.resize(untold.material.find("\ncut_toughness"));
  EXPECT_NE(refusal(untold).find("cut_toughness_J_per_m2"), std::string::npos) << refusal(untold);
  Recipe implicit = block({"voxel", 2, 0});
  implicit.physics += "\nintegrator = \"backward_euler\"";
  EXPECT_NE(refusal(implicit).find("a scalpel cuts step by step"), std::string::npos) << refusal(implicit);
}

}  // namespace
}  // namespace palpate::physics::test
