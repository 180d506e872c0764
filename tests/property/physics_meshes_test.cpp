// Bodies that are meshes of tetrahedra, through the door of a scene: closed forms, conservation, the ledger, the same bits, and what
// they do beside hexahedra.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "common/error/error.h"
#include "common/message/vec3.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "physics_node/contact/point_tool.h"
#include "physics_node/remarks/remarks.h"
#include "physics_node/world.h"
#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double g = 9.81;  // [m/s^2]
const std::string down = "[0, 0, -9.81]";

void run(World& world, int frames) {
  for (int n = 0; n < frames; ++n) world.frame({});
}

/// Mean displacement of the nodes that rest within a nanometre of a plane.
Vec3 mean_at(const World& world, int axis, double height) {
  const BodyModel& body = world.body(0);
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const Index node : body.body().nodes())
    if (std::abs(body.body().rest_position(node)[axis] - height) < 1e-9)
      sum += body.displacement(node), count += 1;
  EXPECT_GT(count, 0);
  return sum / count;
}

double lowest(const World& world, std::size_t b = 0) {
  double least = HUGE_VAL;
  for (const Index node : world.body(b).body().nodes())
    least = std::min(least, world.body(b).position(node).z());
  return least;
}

/// Of a bar that hangs: rho g L^2 / (2 E), without Poisson's ratio exactly so for small strain.
TEST(Mesh, ABarIsLongerByItsWeight) {
  constexpr double length = 0.08, modulus = 200e3, elongation = 1000 * g * length * length / (2 * modulus);
  for (const char* elements : {"plain", "nodal_pressure", "second_order"}) {
    Recipe recipe = mesh_box({2, 2, 8}, 0.01, elements);
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 200\npoisson_ratio = 0";
    recipe.body = "fixed = [\"+z\"]\nstart = \"balanced\"";
    recipe.gravity = down;
    World world(scene_of(recipe));
    const double begins = -mean_at(world, 2, -0.04).z();
    run(world, 200);
    const double stays = -mean_at(world, 2, -0.04).z();
    std::printf("%s: %.5f of rho g L^2 / 2 E, after 0.2 s %.5f\n", elements, begins / elongation,
                stays / elongation);
    EXPECT_NEAR(begins / elongation, 1, 0.01) << elements;
    EXPECT_NEAR(stays / begins, 1, 1e-4) << elements << ": where it rests forces are none, in a step, too";
    EXPECT_LT(world.ledger().kinetic, 1e-6 * world.ledger().elastic);
  }
}

/// Under its weight: 1.5 rho g L^4 / (E h^2) + shear, 1.2 rho g L^2 (1 + nu) / E.
TEST(Mesh, ACantileverBendsAsItsElementsDo) {
  constexpr double L = 0.16, h = 0.02, modulus = 4e6, nu = 0.45;
  const double timoshenko =
      1.5 * 1000 * g * std::pow(L, 4) / (modulus * h * h) + 1.2 * 1000 * g * L * L * (1 + nu) / modulus;
  struct Case {
    const char* elements;
    int cells;
    double least, most;
  };
  // As docs/benchmarks.md has it of an end load, over quadratic bricks: 0.608, 0.834, 0.980.
  for (const Case& c :
       {Case{"plain", 4, 0.55, 0.70}, {"nodal_pressure", 4, 0.78, 0.90}, {"second_order", 2, 0.93, 1.01}}) {
    Recipe recipe = mesh_box({8 * c.cells, c.cells, c.cells}, h / c.cells, c.elements, 0);
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 4000\npoisson_ratio = 0.45";
    recipe.body = "fixed = [\"-x\"]\nstart = \"balanced\"";
    recipe.gravity = down;
    const World world(scene_of(recipe));
    const double tip = -mean_at(world, 0, L / 2).z() / timoshenko;
    std::printf("%s, %d cells high: %.4f of Timoshenko's\n", c.elements, c.cells, tip);
    EXPECT_GT(tip, c.least) << c.elements;
    EXPECT_LT(tip, c.most) << c.elements;
  }
}

TEST(Mesh, InFreeFlightKeepsItsMomenta) {
  for (const char* elements : {"plain", "nodal_pressure", "second_order"}) {
    World world(scene_of(mesh_box({4, 3, 2}, 0.01, elements)));
    Dice dice(3);
    const Vec3 flight(0.3, -0.2, 0.5), spin(3, -2, 5);
    BodyModel& body = world.body(0);
    for (const Index node : body.body().nodes()) {
      const Vec3 rest = body.body().rest_position(node);
      body.place(node, dice.within(3e-5), flight + spin.cross(rest) + dice.within(0.005));
    }
    world.restart_ledger();
    const Momenta before = body.momenta();
    run(world, 300);
    const Momenta after = body.momenta();
    EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm()) << elements;
    EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.angular.norm()) << elements;
    EXPECT_LT(world.ledger().balance_error(), 1e-3) << elements;
    EXPECT_EQ(world.report().restored, 0);
  }
}

TEST(Mesh, OfTheFloorKeepsItsBooks) {
  struct Case {
    const char *material, *contact, *precision;
  };
  for (const Case& c : {Case{"", "", "single"},
                        {"", "", "double"},
                        {"\nviscosity_Pa_s = 2", "[contact]\nrestitution = 0.5\n", "single"}}) {
    Recipe recipe = mesh_box({6, 6, 4}, 0.005);
    recipe.material += c.material;
    recipe.body = "velocity_m_per_s = [0, 0, -0.5]";
    recipe.gravity = down;
    recipe.precision = c.precision;
    recipe.world = floor_at(-15) + c.contact;
    World world(scene_of(recipe));
    double least = 0, up = -HUGE_VAL;
    for (int n = 0; n < 60; ++n) {
      world.frame({});
      least = std::min(least, lowest(world));
      up = std::max(up, world.body(0).momenta().linear.z());
    }
    std::printf("%s%s: balance error %.2e, watched %.2e, %.3f mm below the floor\n", c.precision, c.material,
                world.ledger().balance_error(), world.watched_ledger().balance_error(),
                1e3 * (-0.015 - least));
    EXPECT_LT(world.ledger().balance_error(), 0.01);
    EXPECT_LT(world.watched_ledger().balance_error(), 0.01);
    const double came = 0.5 * 1000 * 0.03 * 0.03 * 0.02;  // m v
    EXPECT_GT(up / came, 0.2) << "comes back up";
    EXPECT_LT(up / came, 1);
    EXPECT_GT(least, -0.016);
    EXPECT_EQ(world.report().restored, 0);
    const MomentumBalance balance = world.body(0).momentum_balance();
    EXPECT_LT(balance.missing.linear.norm(), (c.precision[0] == 's' ? 1e-5 : 1e-12) * balance.linear);
  }
}

/// A ball that nothing holds, much damped, falls on the floor and comes to rest: a damper that a turning body felt would spin it up.
TEST(Mesh, AMuchDampedBallComesToRestOnTheFloor) {
  constexpr double radius = 0.02, height = 0.01;
  TetMesh ball = make_tet_box({.cells = {4, 4, 4}, .edge = radius / 2});
  for (Vec3& x : ball.nodes) {
    const Vec3 c = x - Vec3::Constant(radius);
    x = c.norm() > 0 ? Vec3(c * (c.cwiseAbs().maxCoeff() / c.norm())) : c;
  }
  Recipe recipe = mesh_box({1, 1, 1}, 0.01);
  recipe.shape =
      "shape = \"mesh\"\nunit = \"mm\"\nelements = \"nodal_pressure\"\nfile = \"" + mesh_file(ball) + "\"";
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 5\npoisson_ratio = 0.45\nviscosity_Pa_s = 50";
  recipe.gravity = down;
  recipe.precision = "single";
  recipe.world = floor_at(-1e3 * (radius + height));
  World world(scene_of(recipe));
  double lost = 0;
  std::array<double, 10> most{};  // kinetic, of each tenth of the time [J]
  for (int n = 0; n < 300; ++n) {
    world.frame({});
    const EnergyLedger now = world.ledger();
    EXPECT_GE(now.dissipated, lost);
    lost = now.dissipated;
    double& of_tenth = most[static_cast<std::size_t>(n) / 30];
    of_tenth = std::max(of_tenth, now.kinetic);
  }
  for (const double kinetic : most) std::printf("%.2e ", kinetic);
  std::printf("J; %.2e J lost, balance error %.1e\n", lost, world.ledger().balance_error());
  EXPECT_GT(lost, 0.1 * *std::ranges::max_element(most));
  EXPECT_LT(most[9], 1e-4 * *std::ranges::max_element(most));
  EXPECT_LT(most[9], most[5]);
  EXPECT_EQ(world.report().restored, 0);
}

/// A hand that feels `force` with its proxy at p.
std::optional<ToolState> hand_at(const Vec3& p, double force, std::uint64_t tick) {
  ToolState state;
  state.tick = tick;
  state.p_WT = state.proxy = array(p);
  state.force_on_hand = state.force_now = {0, 0, force};
  state.engaged = 1;
  return state;
}

void press(World& world, double force, int frames) {
  for (int n = 0; n < frames; ++n) {
    const auto hand = hand_at({0.0004, 0.0007, 0.01}, force, static_cast<std::uint64_t>(n) + 1);
    world.frame(std::span(&hand, 1));
  }
}

Recipe pressed_mesh(const std::string& elements) {
  Recipe recipe = mesh_box({16, 16, 8}, 0.0025, elements, 0);
  recipe.material += "\nviscosity_Pa_s = 2";
  recipe.body = "fixed = [\"-z\"]";
  recipe.precision = "single";
  recipe.world = point_tool(5);
  return recipe;
}

TEST(Mesh, GivesTheSameBitsOnAnyNumberOfThreads) {
  for (const char* elements : {"nodal_pressure", "second_order"}) {
    std::uint64_t first = 0;
    for (const int threads : {1, 2, 3, 8}) {
      Recipe recipe = pressed_mesh(elements);
      recipe.physics = "threads = " + std::to_string(threads);
      World world(scene_of(recipe));
      press(world, 0.1, 20);
      EXPECT_GT(dynamic_cast<const PointTool&>(world.tool(0)).depth(), 0);
      if (threads == 1) first = world.state_hash();
      EXPECT_EQ(world.state_hash(), first) << threads << " threads, " << elements;
    }
  }
}

/// The same force on the same block: how deep the sphere rests.
TEST(Mesh, IsPressedAsHexahedraAre) {
  constexpr double force = 0.15;
  const auto depth = [&](const Recipe& recipe) {
    World world(scene_of(recipe));
    press(world, force, 1200);
    EXPECT_EQ(world.report().restored, 0);
    EXPECT_LT(world.ledger().balance_error(), 0.01);
    return dynamic_cast<const PointTool&>(world.tool(0)).depth();
  };
  Recipe cells = pressed_mesh("plain");
  cells.lattice = "voxel";
  cells.spacing_mm = 2.5;
  cells.shape = Recipe::box(40, 40, 20);
  cells.body += "\nmodel = \"fem\"";
  const double of_cells = depth(cells);
  for (const auto& [elements, within] :
       std::map<std::string, double>{{"nodal_pressure", 0.1}, {"second_order", 0.1}}) {
    const double of_mesh = depth(pressed_mesh(elements));
    std::printf("%s: %.3f mm deep, hexahedra %.3f mm: %.3f\n", elements.c_str(), 1e3 * of_mesh,
                1e3 * of_cells, of_mesh / of_cells);
    EXPECT_NEAR(of_mesh / of_cells, 1, within) << elements;
  }
}

/// One falls onto the other, which is held; nothing goes into the other, and it comes up again.
TEST(Mesh, AndVoxelsCollideAndDoNotPass) {
  const std::string cube =
      "[[body]]\nname = \"other\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm = 5\nmaterial = "
      "\"m\"\nshape = \"box\"\nsize_mm = [30, 30, 20]\n";
  for (const bool mesh_falls : {true, false}) {
    Recipe recipe = mesh_box({6, 6, 4}, 0.005);
    const std::string falls = "at_mm = [1, 2, 25]\nvelocity_m_per_s = [0, 0, -1]\n",
                      held = "fixed = [\"-z\"]\n";
    recipe.body = mesh_falls ? falls : held;
    recipe.world = cube + (mesh_falls ? held : falls);
    World world(scene_of(recipe));
    ASSERT_NE(world.collisions(), nullptr);
    Index most = 0;
    InsideOthers inside = *world.inside_others();
    for (int n = 0; n < 80; ++n) {
      world.frame({});
      inside.look();
      most = std::max({most, inside.now(0), inside.now(1)});
    }
    const Vec3 momentum = world.body(mesh_falls ? 0 : 1).momenta().linear;
    std::printf("mesh %s: %lld collisions, momentum after %.4f N s, balance error %.2e\n",
                mesh_falls ? "falls" : "is hit",
                static_cast<long long>(world.collisions()->tally().collisions), momentum.z(),
                world.ledger().balance_error());
    EXPECT_GT(world.collisions()->tally().collisions, 0);
    EXPECT_EQ(most, 0) << "nodes inside the other";
    EXPECT_GT(momentum.z(), 0.001) << "comes up again";
    EXPECT_EQ(world.report().restored, 0);
    EXPECT_LT(world.ledger().balance_error(), 0.01);
  }
}

/// What lies in a tetrahedron is found, and what lies beside the mesh is not.
TEST(Mesh, KnowsWhatIsInsideIt) {
  Recipe recipe = mesh_box({4, 4, 4}, 0.01);
  recipe.world =
      "[contact]\nenabled = false\n[[body]]\nname = \"other\"\nlattice = \"voxel\"\nspacing_mm = 5\nmaterial "
      "= "
      "\"m\"\nmodel = \"fem\"\nshape = \"box\"\nsize_mm = [10, 10, 10]\nat_mm = [20, 0, 0]\n";
  const World world(scene_of(recipe));
  InsideOthers inside = *world.inside_others();
  inside.look();
  EXPECT_EQ(inside.now(1), 9) << "those at 15 mm; what is flush with its face, at 20 mm, is outside";
}

/// Pressed until it is half as thin: frames are cut finer than at rest.
TEST(Mesh, StiffensWhereItIsCrushed) {
  World world(scene_of(pressed_mesh("nodal_pressure")));
  press(world, 0.4, 300);
  EXPECT_EQ(world.report().restored, 0);
  const double at_rest = std::ceil(1e-3 / (0.8 * world.stable_step_seconds()));  // steps of a frame
  EXPECT_GT(static_cast<double>(world.report().steps), static_cast<double>(world.report().frames) * at_rest);
  std::printf("%.2f steps a frame, at rest %.0f, J down to %.2f\n",
              static_cast<double>(world.report().steps) / static_cast<double>(world.report().frames), at_rest,
              world.report().least_corner_J);
  EXPECT_GT(world.report().least_corner_J, 0);
  EXPECT_LT(world.report().least_corner_J, 0.9);
}

TEST(Mesh, SaysWhatItsFileHadToBeMended) {
  TetMesh mesh = make_tet_box({.edge = 0.02});
  for (std::size_t t = 0; t < 2; ++t) std::swap(mesh.tets[t][0], mesh.tets[t][1]);
  mesh.nodes.push_back({0.01, 0.01, 0.01});
  Recipe recipe = mesh_box({1, 1, 1}, 0.02);
  recipe.body = "fixed = [\"-z\"]";
  EXPECT_EQ(remarks_about(World(scene_of(recipe))), Remarks{});
  recipe.shape = "shape = \"mesh\"\nunit = \"mm\"\nfile = \"" + mesh_file(mesh) + "\"";
  const World world(scene_of(recipe));
  EXPECT_THAT(remarks_about(world),
              testing::ElementsAre(testing::HasSubstr("2 of its 6 tetrahedra were inside out"),
                                   testing::HasSubstr("1 nodes of its file are of no")));
  EXPECT_EQ(world.body(0).body().n_nodes(), 8);
}

TEST(Mesh, OfPartsThatNothingJoinsIsRemarkedOn) {
  TetMesh mesh = make_tet_box({.edge = 0.02});
  const auto n = static_cast<Index>(mesh.nodes.size());
  for (Index node = 0; node < n; ++node)
    mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)] + Vec3(0, 0, 0.02));
  for (std::size_t t = 0; t < 6; ++t) {
    mesh.tets.push_back(mesh.tets[t]);
    for (Index& corner : mesh.tets.back()) corner += n;
  }
  Recipe recipe = mesh_box({1, 1, 1}, 0.02);
  recipe.body = "fixed = [\"-z\"]";
  recipe.shape = "shape = \"mesh\"\nunit = \"mm\"\nfile = \"" + mesh_file(mesh) + "\"";
  EXPECT_THAT(remarks_about(World(scene_of(recipe))),
              testing::ElementsAre(testing::HasSubstr("its mesh is 2 parts that share no nodes")));
}

TEST(Mesh, OfWhichAllIsThereTwiceIsRefused) {
  TetMesh mesh = make_tet_box({.edge = 0.02});
  for (std::size_t t = 0; t < 6; ++t) mesh.tets.push_back(mesh.tets[t]);
  Recipe recipe = mesh_box({1, 1, 1}, 0.02);
  recipe.shape = "shape = \"mesh\"\nunit = \"mm\"\nfile = \"" + mesh_file(mesh) + "\"";
  EXPECT_THROW(World(scene_of(recipe)), InputError);
  mesh.tets.resize(2);
  mesh.tets[1] = mesh.tets[0];
  recipe.shape = "shape = \"mesh\"\nunit = \"mm\"\nfile = \"" + mesh_file(mesh) + "\"";
  EXPECT_THROW(World(scene_of(recipe)), InputError);
}

TEST(Mesh, IsBalancedOnlyWhereItIsHeld) {
  Recipe recipe = mesh_box({2, 2, 2}, 0.01);
  recipe.gravity = down;
  recipe.body = "start = \"balanced\"";
  EXPECT_THROW(World(scene_of(recipe)), InputError);
  recipe.body += "\nfixed = [\"+z\"]";
  recipe.world = floor_at(-10);
  EXPECT_THROW(World(scene_of(recipe)), InputError) << "it would hang through the floor";
  recipe.world = floor_at(-20);
  EXPECT_NO_THROW(World(scene_of(recipe)));
}

}  // namespace
}  // namespace palpate::physics::test
