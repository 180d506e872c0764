// A frame takes no memory. Every way to operator new in this program is counted while a frame runs.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "physics_node/mesh/renumber.h"
#include "physics_node/mesh/tet_box.h"
#include "physics_node/record/recorder.h"
#include "physics_node/step/fem/tetrahedra.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/mesh_worlds.h"
#include "tests/support/physics/pressed_world.h"

namespace {

thread_local bool in_frame = false;
thread_local std::size_t allocations = 0;

void* taken(std::size_t size) {
  if (in_frame) ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return taken(size); }
void* operator new[](std::size_t size) { return taken(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace palpate::physics::test {
namespace {

std::size_t allocations_in(World& world, const std::optional<ToolState>& hand, int frames) {
  allocations = 0;
  in_frame = true;
  run(world, hand, frames);
  ContactPatch patch;
  ToolWrench wrench;
  for (std::size_t n = 0; n < world.n_tools(); ++n) {
    Tool& tool = world.tool(n);
    tool.write_patch(patch, 1, 1);
    tool.write_wrench(wrench, 1, 1, 0);
  }
  in_frame = false;
  return allocations;
}

TEST(AllocationCount, SeesAnAllocation) {
  allocations = 0;
  in_frame = true;
  delete new int(3);
  in_frame = false;
  EXPECT_EQ(allocations, 1u);
}

TEST(Tetrahedra, TakeNoMemoryInAStep) {
  TetModel model{.mesh = make_tet_box({.cells = {8, 8, 8}, .edge = 0.0025}),
                 .materials = {{}},
                 .held = {},
                 .beta = 1e-4};
  renumber(model.mesh);
  Tetrahedra<float> body(model);
  Team team(2);
  allocations = 0;
  in_frame = true;
  for (int n = 0; n < 8; ++n)
    body.step(
        {.dt = 5e-5, .gravity = Vec3(0, 0, -9.81), .team = &team, .threads = 1 + n % 2, .watch = n % 4 == 3});
  in_frame = false;
  EXPECT_EQ(allocations, 0u);
}

/// Pressed by a hand, and fallen onto by a cube, which then falls onto the floor.
TEST(World, OfAMeshTakesNoMemoryInAFrame) {
  Recipe recipe = mesh_box({12, 12, 5}, 0.004);
  recipe.precision = "single";
  recipe.material += "\nviscosity_Pa_s = 1";
  recipe.body = "fixed = [\"-z\"]";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.physics = "threads = 2";
  recipe.world =
      point_tool(4) + floor_at(-12) +
      "[[body]]\nname = \"cube\"\nshape = \"box\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm = "
      "4\nsize_mm = [12, 12, 12]\nat_mm = [20, 20, 17]\nvelocity_m_per_s = [0.5, 0, -1]\nmaterial = \"m\"\n";
  World world(scene_of(recipe));
  EXPECT_EQ(allocations_in(world, steady_hand({0, 0, 0.2}), 60), 0u);
  EXPECT_FALSE(forces_of_tool(world).empty());
  EXPECT_GT(world.collisions()->tally().collisions, 0);
}

TEST(World, OfASurfaceTakesNoMemoryInAFrame) {
  Recipe recipe = mesh_box({12, 12, 5}, 0.004, "plain", 0);
  const std::string elements = "elements = \"plain\"\n";
  recipe.shape.replace(
      recipe.shape.find(elements), elements.size(),
      "model = \"surface\"\nthickness_mm = 2\npressure_kPa = 0.5\ncontent_modulus_kPa = 20\n");
  recipe.precision = "single";
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 50\nviscosity_Pa_s = 1";
  recipe.body = "fixed = [\"-z\"]";
  recipe.physics = "threads = 2";
  recipe.world = point_tool(4) + floor_at(-12);
  World world(scene_of(recipe));
  EXPECT_EQ(allocations_in(world, steady_hand({0, 0, 0.2}), 60), 0u);
  EXPECT_FALSE(forces_of_tool(world).empty());
}

TEST(World, TakesNoMemoryInAFrameWhateverHappens) {
  World world(pressed_slab());
  EXPECT_EQ(allocations_in(world, std::nullopt, 5), 0u);  // before the hand is there
  auto hand = steady_hand({0, 0, 1});
  EXPECT_EQ(allocations_in(world, hand, 50), 0u);
  hand->proxy = {0.02, -0.02, slab_top};
  EXPECT_EQ(allocations_in(world, hand, 50), 0u);  // elsewhere
  hand->proxy = {0, 0, 0.5};
  EXPECT_EQ(allocations_in(world, hand, 50), 0u);  // far away
  EXPECT_EQ(allocations_in(world, std::nullopt, 50), 0u);
}

TEST(World, TakesNoMemoryWhileItSolvesFiniteElements) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(60, 60, 40);
  recipe.spacing_mm = 5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\nviscosity_Pa_s = 5";
  recipe.body = "model = \"fem\"\nfixed = [\"-z\"]";
  recipe.physics = "integrator = \"backward_euler\"\nframe_Hz = 50\nthreads = 2";
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  EXPECT_EQ(allocations_in(world, std::nullopt, 10), 0u);
  EXPECT_GT(world.report().cg_iterations, 10);
  EXPECT_EQ(world.report().unsolved, 0);
}

TEST(World, TakesNoMemoryWhileItSolvesForAFloor) {
  for (const char* model : {"fem", "springs"}) {
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.spacing_mm = 5;
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10";
    recipe.body = std::string("velocity_m_per_s = [0, 0, -1]\nmodel = \"") + model + "\"";
    recipe.physics = "integrator = \"backward_euler\"\nthreads = 2";
    recipe.world = floor_at(-21);
    World world(scene_of(recipe));
    EXPECT_EQ(allocations_in(world, std::nullopt, 10), 0u);
    EXPECT_GT(world.body(0).momenta().linear.z(), -0.9 * 0.0625) << "it has met the floor";
  }
}

TEST(World, TakesNoMemoryWhileBodiesThatTouchAreSolved) {
  for (const char* distance : {"swept", "paper"}) {
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.spacing_mm = 5;
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10";
    recipe.body = "model = \"fem\"\nvelocity_m_per_s = [0, 0, 1]";
    recipe.physics = "integrator = \"backward_euler\"\nthreads = 2";
    recipe.world = std::string("[contact]\ndistance = \"") + distance +
                   "\"\n[[body]]\nname = \"upper\"\nlattice = \"voxel\"\nspacing_mm = 5\nmaterial = \"m\"\n"
                   "shape = \"box\"\nsize_mm = [20, 20, 20]\nat_mm = [0, 0, 34]\n";
    World world(scene_of(recipe));
    EXPECT_EQ(allocations_in(world, std::nullopt, 30), 0u);
    EXPECT_GT(world.body(1).momenta().linear.z(), 1e-3) << "it was hit";
  }
}

TEST(World, TakesNoMemoryWhileItYieldsAndBreaks) {
  Recipe recipe;
  recipe.body = "velocity_m_per_s = [0, 0, -3]";
  recipe.material += "\nyield_ratio = 1.01\nbreak_ratio = 1.05";
  recipe.world = floor_at(-21);
  World world(scene_of(recipe));
  EXPECT_EQ(allocations_in(world, std::nullopt, 100), 0u);
  EXPECT_GT(world.report().broken, 0);
}

TEST(World, TakesNoMemoryWhileATipBreaksTissue) {
  Recipe recipe = pressed_slab_recipe();
  recipe.material += "\nyield_ratio = 1.02\nbreak_ratio = 1.05";
  World world(scene_of(recipe));
  EXPECT_EQ(allocations_in(world, steady_hand({0, 0, 5}), 300), 0u);
  EXPECT_GT(world.report().broken, 50);
}

TEST(Recorder, TakesNoMemoryOfTheFramesThread) {
  const palpate::test::ScratchFolder folder;
  Recipe recipe = pressed_slab_recipe();
  recipe.world += "[record]\nwhat = [\"positions\", \"forces\", \"energy\"]\n";
  World world(scene_of(recipe));
  Recorder recorder(world, SceneSource{}, folder.path(), Recorder::WhenBehind::wait);
  auto hand = steady_hand({0, 0, 1});
  allocations = 0;
  for (int n = 0; n < 100; ++n) {
    ++hand->tick;
    in_frame = true;
    world.frame(std::span(&hand, 1));
    recorder.frame(world, std::span(&hand, 1));
    if (n == 50) recorder.command(world, {});
    if (n % 10 == 0) recorder.status({});
    in_frame = false;
  }
  EXPECT_EQ(allocations, 0u);
  recorder.finish(world);
}

}  // namespace
}  // namespace palpate::physics::test
