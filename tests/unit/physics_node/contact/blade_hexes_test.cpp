// A scalpel that goes through cells of finite elements: it feels toughness times length whatever the cells, what it passes
// parts, and nothing is lost.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/scene/scene.h"
#include "physics_node/boundary/boundary.h"
#include "physics_node/contact/blade_cells.h"
#include "physics_node/fragments/fragments.h"
#include "physics_node/world.h"
#include "tests/support/physics/blade_checks.h"

namespace palpate::physics::test {
namespace {

constexpr double toughness = 190;
const Vec3 size(0.030, 0.016, 0.010);  // of the block; the edge is along z, the cut along x
constexpr double plane = 0.0003;       // of the blade: y [m]
const BladeChecks checks{size, Vec3(0, plane, -0.010)};

struct Case {
  double cell_mm, speed;  // [m/s]
  bool damped = true;
  const char* precision = "double";
};

Recipe block(const Case& c, const std::string& body = "fixed = [\"-y\", \"+y\"]") {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(30, 16, 10);
  recipe.spacing_mm = c.cell_mm;
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 200\npoisson_ratio = 0.45\ncut_toughness_J_per_m2 = 190\n" +
      (c.damped ? std::string("viscosity_Pa_s = 0.2") : std::string());
  recipe.body = "model = \"fem\"\nat_mm = [0, 0, 0]\n" + body;
  recipe.physics = "frame_Hz = 1000";
  recipe.precision = c.precision;
  recipe.world = fmt::format(
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 20\ndevice = \"hand\"\n"
      "stiffness_N_per_m = 1000\nedge_deg = 0\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 30, 0, 0], [1, 20, 0, 0]]\n");
  return recipe;
}

const CellNet& net_of(const World& world) { return *world.body(0).body().cell_net(); }

/// Between the first piece and the others, as seen along the normal [m^2].
double parted_across(const World& world, const Vec3& normal) {
  const Body& body = world.body(0).body();
  const CellNet& net = net_of(world);
  const auto piece = [&](Index cell) { return world.fragments(0)->label(net.corners(cell)[0]); };
  double area = 0;
  for (const Index cell : net.cells())
    for (std::size_t f = 0; f < CellNet::n_faces; ++f) {
      if (!net.is_open(cell, f) || piece(cell) != 0 || piece(net.beyond(cell, f)) == 0) continue;
      const CellNet::Face face = net.face(cell, f);
      area += 0.5 * (body.rest_position(face[2]) - body.rest_position(face[0]))
                        .cross(body.rest_position(face[3]) - body.rest_position(face[1]))
                        .dot(normal);
    }
  return std::abs(area);
}

struct Cut : LedBlade {
  explicit Cut(const Recipe& recipe, double y = plane) : LedBlade(recipe, Vec3(0.020, y, -0.010)) {}
};

class ScalpelInCells : public testing::TestWithParam<Case> {};

TEST_P(ScalpelInCells, FeelsToughnessTimesLengthAndPaysForTheAreaThatItOpens) {
  const Case c = GetParam();
  Cut cut(block(c));
  const double begin = 0.020, end = -0.035, from = begin + 0.45 * (end - begin),
               to = begin + 0.65 * (end - begin);
  cut.along(Vec3(from, plane, -0.010), c.speed);
  const LedBlade::Stroke steady = cut.stroke(Vec3(to, plane, -0.010), c.speed);
  EXPECT_NEAR(steady.opened, size.z(), 0.03 * size.z());
  EXPECT_NEAR(steady.force - steady.viscous, toughness * size.z(), 0.05 * toughness * size.z());
  // The edge lies along rows of cells, which open all at once.
  EXPECT_LT(steady.jump, 0.12 * toughness * size.z()) << "of a frame";

  cut.along(Vec3(end, plane, -0.010), c.speed);
  const double area = size.x() * size.z();
  EXPECT_EQ(cut.world.fragments(0)->count(), 2);
  EXPECT_NEAR(cut.book().cut_area(), area, 0.07 * area);
  EXPECT_NEAR(parted_across(cut.world, Vec3::UnitY()), area, 1e-9 * area) << "all of the section";
  const EnergyLedger ledger = cut.world.ledger();
  EXPECT_NEAR(ledger.cut, toughness * cut.book().cut_area(), 1e-9);
  EXPECT_LT(ledger.balance_error(), 1e-3);
  EXPECT_EQ(cut.world.report().restored, 0);
  EXPECT_GT(cut.world.report().least_corner_J, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Cells, ScalpelInCells,
                         testing::Values(Case{2, 0.05}, Case{2, 0.2}, Case{1, 0.2},
                                         Case{2, 0.2, true, "single"}),
                         [](const testing::TestParamInfo<Case>& one) { return std::to_string(one.index); });

/// All faces in the plane between cells that is nearest to the blade's.
std::vector<EdgeGone> across_the_plane(const World& world) {
  const Body& body = world.body(0).body();
  const CellNet& net = net_of(world);
  std::vector<EdgeGone> faces;
  for (const Index cell : net.cells()) {
    const Index other = net.beyond(cell, 3);
    if (other != CellNet::none && body.rest_position(cell).y() < -0.5e-3 &&
        body.rest_position(other).y() > -0.5e-3)
      faces.push_back({cell, other, {}});
  }
  return faces;
}

/// A free body: mass, momentum and angular momentum stay to rounding, and energy but for what is booked.
TEST(ScalpelInCells, LosesNothingByParting) {
  checks.expect_nothing_lost(block({.cell_mm = 2, .speed = 0, .damped = false}, ""));
}

/// Parts that are not joined fly apart as two bodies do: each keeps its own momentum, and no force is between them.
TEST(ScalpelInCells, LeavesTwoBodies) {
  Recipe recipe = block({.cell_mm = 2, .speed = 0, .damped = false}, "");
  World world(scene_of(recipe));
  BodyModel& moving = world.body(0);
  const CellNet& net = net_of(world);
  const Body& body = moving.body();
  const std::vector<EdgeGone> faces = across_the_plane(world);
  ASSERT_EQ(faces.size(), 15U * 5U);
  const double energy = moving.energy_now();
  EXPECT_EQ(moving.cut(faces), 75);
  EXPECT_EQ(moving.cut(faces), 0);
  EXPECT_EQ(net.n_copies(), 16 * 6);
  EXPECT_EQ(moving.energy_now(), energy);
  std::set<Index> upper;
  for (const Index cell : net.cells())
    if (body.rest_position(cell).y() > -0.5e-3)
      for (const Index node : net.corners(cell)) upper.insert(node);
  body.each_node([&](Index node) {
    const bool up = upper.contains(node);
    moving.place(node, up ? Vec3(0, 0.001, 0) : Vec3(Vec3::Zero()), Vec3(0, up ? 0.3 : -0.1, 0));
  });
  for (int n = 0; n < 20; ++n) moving.advance({.dt = 1e-4, .gravity = Vec3::Zero()}, {});
  body.each_node([&](Index node) {
    EXPECT_NEAR(moving.velocity(node).y(), upper.contains(node) ? 0.3 : -0.1, 1e-9);
    EXPECT_NEAR(moving.displacement(node).y(), upper.contains(node) ? 0.0016 : -0.0002, 1e-9);
  });
  const Fragments pieces(moving);
  EXPECT_EQ(pieces.count(), 2);
}

TEST(ScalpelInCells, FeelsNothingInItsOwnSlot) { checks.expect_nothing_felt_in_its_slot(block({2, 0.05})); }

TEST(ScalpelInCells, CutsTheSameOnAnyNumberOfThreadsAndAgainAfterAReset) {
  checks.expect_the_same_again(block({2, 0.2}));
}

/// The step that holds for one cell alone holds whatever is cut, and is not more than some half as long again as that of the whole.
TEST(ScalpelInCells, KeepsItsStepWhenAllIsCrumbs) {
  Recipe recipe = block({.cell_mm = 2, .speed = 0, .damped = false}, "");
  Recipe uncut = recipe;
  uncut.world.clear();
  World world(scene_of(recipe));
  const double whole = World(scene_of(uncut)).stable_step_seconds();
  EXPECT_LT(world.stable_step_seconds(), whole);
  EXPECT_GT(world.stable_step_seconds(), 0.6 * whole);
  BodyModel& moving = world.body(0);
  const CellNet& net = net_of(world);
  std::vector<EdgeGone> faces;
  for (const Index cell : net.cells())
    for (std::size_t f = 1; f < CellNet::n_faces; f += 2)
      if (const Index other = net.beyond(cell, f); other != CellNet::none) faces.push_back({cell, other});
  EXPECT_EQ(moving.cut(faces), static_cast<std::int64_t>(faces.size()));
  std::size_t n = 0;
  moving.body().each_node([&](Index node) {
    const double way = 1e-6 * static_cast<double>(n++ % 7);
    moving.place(node, Vec3(way, -way, 2e-6 - way), Vec3::Zero());
  });
  const double energy = moving.energy_now();
  const auto after = [&](double share) {
    const ExplicitStep step{.dt = share * world.stable_step_seconds(), .gravity = Vec3::Zero()};
    for (int i = 0; i < 3000; ++i) moving.advance(step, {});
    return moving.energy_now() / energy;
  };
  // K + U of one moment; what the leapfrog keeps is 1 - (w dt / 2)^2 of it.
  EXPECT_LT(after(0.99), 1 / (1 - 0.99 * 0.99));
  EXPECT_FALSE(after(1.03) < 1e3) << "and no longer one";
}

/// Both lips are there to be touched, where the tissue is, and all of the surface is closed.
TEST(ScalpelInCells, OpensFacetsOnBothSides) {
  Cut cut(block({2, 0.2}));
  Boundary surface(cut.world.body(0), 0.01, true);
  cut.along(Vec3(0, plane, -0.010), 0.2);
  surface.follow();
  Boundary fresh(cut.world.body(0), 0.01, true);
  fresh.update();
  const BodyModel& moving = cut.world.body(0);
  double opened = 0;
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t facet = 0; facet < fresh.most_facets(); ++facet) {
    if (!fresh.exists(facet)) continue;
    sum += fresh.centroid_and_area(facet, moving).area;
    if (std::abs(fresh.settled_centroid(facet).y()) < 1.1e-3 &&
        std::abs(fresh.rest_area(facet).normalized().y()) > 0.9)
      opened += fresh.rest_area(facet).norm();
  }
  EXPECT_LT(sum.norm(), 1e-9) << "closed";
  EXPECT_NEAR(opened, 2 * cut.book().cut_area(), 0.2 * cut.book().cut_area());
}

std::string refusal(const std::string& material, const std::string& body = "") {
  Recipe recipe = block({2, 0});
  recipe.material += "\n" + material;
  recipe.body += "\n" + body;
  try {
    World world(scene_of(recipe));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ScalpelInCells, SaysWhatItCannotCut) {
  for (const char* more :
       {"break_ratio = 1.3", "yield_ratio = 1.2\nk2_ratio = 0.1", "relaxation = [[0.3, 1]]"})
    EXPECT_NE(refusal(more).find("\"body\" is of finite elements that yield, break or relax"),
              std::string::npos)
        << refusal(more);
}

}  // namespace
}  // namespace palpate::physics::test
