// What an edge goes between in tetrahedra, and a scalpel that goes through them: it feels toughness times length whatever
// the mesh, what it passes parts, and nothing is lost.

#include "physics_node/contact/blade_cells.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/blade_checks.h"
#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double toughness = 190;
const Vec3 size(0.030, 0.016, 0.010);  // of the block; the edge is along z, the cut along x
constexpr double plane = 0.0003;       // of the blade: y [m]
const BladeChecks checks{size, Vec3(0, plane, -0.010)};

struct Case {
  double edge_mm, speed;  // [m/s]
  const char* elements = "nodal_pressure";
  bool damped = true;
};

Recipe block(const Case& c, const std::string& body = "fixed = [\"-y\", \"+y\"]") {
  std::array<int, 3> cells{};
  for (std::size_t a = 0; a < 3; ++a)
    cells[a] = static_cast<int>(std::lround(1e3 * size[static_cast<Eigen::Index>(a)] / c.edge_mm));
  Recipe recipe = mesh_box(cells, 1e-3 * c.edge_mm, c.elements);
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 200\npoisson_ratio = 0.45\ncut_toughness_J_per_m2 = 190\n" +
      (c.damped ? std::string("viscosity_Pa_s = 0.2") : std::string());
  recipe.body = "at_mm = [0, 0, 0]\n" + body;
  recipe.physics = "frame_Hz = 1000";
  recipe.world =
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 20\ndevice = \"hand\"\n"
      "stiffness_N_per_m = 1000\nedge_deg = 0\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 30, 0, 0], [1, 20, 0, 0]]\n";
  return recipe;
}

const TetNet& net_of(const World& world) { return *world.body(0).body().mesh->net; }

/// Between the first piece and the others, as seen along the normal [m^2].
double parted_across(const World& world, const Vec3& normal) {
  const Body& body = world.body(0).body();
  const TetNet& net = net_of(world);
  const auto piece = [&](Index t) { return world.fragments(0)->label(net.corners(t)[0]); };
  double area = 0;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      if (!net.is_open(t, f) || piece(t) != 0 || piece(net.beyond(t, f)) == 0) continue;
      const MeshTriangle face = net.face(t, f);
      const Vec3 a = body.rest_position(face[0]);
      area += 0.5 * (body.rest_position(face[1]) - a).cross(body.rest_position(face[2]) - a).dot(normal);
    }
  return std::abs(area);
}

struct Cut : LedBlade {
  explicit Cut(const Recipe& recipe, double y = plane) : LedBlade(recipe, Vec3(0.020, y, -0.010)) {}
};

class ScalpelInTetrahedra : public testing::TestWithParam<Case> {};

TEST_P(ScalpelInTetrahedra, FeelsToughnessTimesLengthAndPaysForTheAreaThatItOpens) {
  const Case c = GetParam();
  Cut cut(block(c));
  const double begin = 0.020, end = -0.035, from = begin + 0.45 * (end - begin),
               to = begin + 0.65 * (end - begin);
  cut.along(Vec3(from, plane, -0.010), c.speed);
  const LedBlade::Stroke steady = cut.stroke(Vec3(to, plane, -0.010), c.speed);
  EXPECT_NEAR(steady.opened, size.z(), 0.03 * size.z());
  EXPECT_NEAR(steady.force - steady.viscous, toughness * size.z(), 0.05 * toughness * size.z());
  EXPECT_LT(steady.jump, 0.03 * toughness * size.z()) << "of a frame";

  cut.along(Vec3(end, plane, -0.010), c.speed);
  const double area = size.x() * size.z();
  EXPECT_EQ(cut.world.fragments(0)->count(), 2);
  EXPECT_NEAR(cut.book().cut_area(), area, 0.05 * area) << "at both ends a part of a tetrahedron is missing";
  EXPECT_NEAR(parted_across(cut.world, Vec3::UnitY()), area, 1e-9 * area) << "all of the section";
  const EnergyLedger ledger = cut.world.ledger();
  EXPECT_NEAR(ledger.cut, toughness * cut.book().cut_area(), 1e-9);
  EXPECT_LT(ledger.balance_error(), 1e-3);
  EXPECT_EQ(cut.world.report().restored, 0);
  EXPECT_GT(cut.world.report().least_corner_J, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Meshes, ScalpelInTetrahedra,
                         testing::Values(Case{2.5, 0.05}, Case{2, 0.2}, Case{2, 0.1}, Case{2, 0.2, "plain"}),
                         [](const testing::TestParamInfo<Case>& one) { return std::to_string(one.index); });

/// Tough tissue holds the blade back by 5 mm, and where it ends the hand's spring takes it on: through what comes next.
TEST(BladeCells, PassesByNothingWhereTissueLetsGoOfTheBlade) {
  Recipe recipe = block({2, 0});
  recipe.body +=
      "\nregions = [{ material = \"tough\", box_min_mm = [0, -20, -20], box_max_mm = [20, 20, 20] }]";
  recipe.world +=
      "[material.tough]\ndensity_kg_per_m3 = 1000\nmodulus_kPa = 400\npoisson_ratio = 0.45\n"
      "viscosity_Pa_s = 0.4\ncut_toughness_J_per_m2 = 600\n";
  Cut cut(recipe);
  cut.along(Vec3(-0.040, plane, -0.010), 0.2);
  EXPECT_EQ(cut.world.fragments(0)->count(), 2);
  EXPECT_NEAR(cut.book().cut_area(), size.x() * size.z(), 0.05 * size.x() * size.z());
  EXPECT_LT(cut.world.ledger().balance_error(), 1e-4);
}

/// The mass of every piece is that of its tetrahedra, and in all what it was.
TEST(BladeCells, LosesNoMassAndMovesNothingByParting) {
  checks.expect_nothing_lost(block({.edge_mm = 2, .speed = 0, .damped = false}, ""));
}

TEST(BladeCells, FeelsNothingInItsOwnSlot) { checks.expect_nothing_felt_in_its_slot(block({2, 0.05})); }

TEST(BladeCells, CutsTheSameOnAnyNumberOfThreadsAndAgainAfterAReset) {
  checks.expect_the_same_again(block({2, 0.2}));
}

TEST(BladeCells, LieNoFartherApartThanTheEdgeReaches) {
  const World world(scene_of(block({2, 0})));
  const BladeCells cells(world.body(0));
  const TetNet& net = net_of(world);
  std::size_t joined = 0;
  for (const Index cell : cells.all())
    cells.each_joined(cell, [&](Index other) {
      ++joined;
      EXPECT_LE((cells.rest(cell) - cells.rest(other)).norm(), cells.spacing());
    });
  const std::size_t skin = cells.all().size() - static_cast<std::size_t>(net.n_elements());
  EXPECT_EQ(joined, 4 * static_cast<std::size_t>(net.n_elements()) + skin)
      << "each face has two sides, and a skin";
}

}  // namespace
}  // namespace palpate::physics::test
