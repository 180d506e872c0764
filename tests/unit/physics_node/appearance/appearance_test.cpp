#include "physics_node/appearance/appearance.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

using namespace test;

/// A slab with more vertices than a chunk holds.
Recipe large_slab() {
  Recipe recipe = pressed_slab_recipe();
  recipe.shape = Recipe::box(96, 96, 45);
  recipe.spacing_mm = 3;
  recipe.body = "fixed = [\"-z\"]\nat_mm = [0, 0, -12.5]";  // its top is at the slab's
  return recipe;
}

TEST(Appearance, SendsEveryVertexAndFacetOnce) {
  const World world(scene_of(large_slab()));
  Appearance appearance(world, std::nullopt);
  EXPECT_TRUE(appearance.poll());
  std::vector<int> vertices, facets;
  std::uint32_t n_chunks = 0, seen = 0;
  const int written = appearance.write_surfaces([&](const BodySurface& chunk) {
    vertices.resize(chunk.total_vertices), facets.resize(chunk.total_facets);
    n_chunks = chunk.n_chunks;
    EXPECT_EQ(chunk.chunk, seen++);
    EXPECT_EQ(chunk.revision, 1u);
    EXPECT_EQ(chunk.rigid, 0u);
    for (std::uint32_t n = 0; n < chunk.n_vertices; ++n) ++vertices[chunk.first_vertex + n];
    for (std::uint32_t n = 0; n < chunk.n_facets; ++n) {
      ++facets[chunk.first_facet + n];
      for (const auto corner : chunk.corners[n]) EXPECT_LT(corner, chunk.total_vertices);
    }
  });
  EXPECT_GT(n_chunks, 1u);
  EXPECT_EQ(written, static_cast<int>(n_chunks));
  EXPECT_EQ(facets.size(), 2u * (32 * 32 + 2 * 32 * 15));
  EXPECT_EQ(facets.size(), appearance.facets_visible());
  for (const int n : vertices) ASSERT_EQ(n, 1);
  for (const int n : facets) ASSERT_EQ(n, 1);
  EXPECT_FALSE(appearance.poll());
  EXPECT_EQ(appearance.write_surfaces([](const BodySurface&) { ADD_FAILURE(); }), 0);
}

TEST(Appearance, WritesOnlyBlocksThatMoved) {
  World world(scene_of(large_slab()));
  Appearance appearance(world, std::nullopt);
  std::set<std::uint32_t> blocks;
  const auto sink = [&](const VertexBlock& block) {
    EXPECT_TRUE(blocks.insert(block.block).second);
    EXPECT_EQ(block.first_vertex, block.block * max_block_vertices);
  };
  EXPECT_EQ(appearance.write_blocks(sink), 2);  // all, the first time
  EXPECT_EQ(appearance.write_blocks(sink), 0);
  run(world, steady_hand({0, 0, 0.5}), 3);
  blocks.clear();
  EXPECT_EQ(appearance.write_blocks(sink), 1);
  EXPECT_EQ(blocks, std::set<std::uint32_t>{1}) << "vertices at the top come last";
  appearance.resend();
  blocks.clear();
  EXPECT_EQ(appearance.write_blocks(sink), 2);
}

TEST(Appearance, LeavesABodyAtRestAlone) {
  Recipe recipe;
  recipe.world =
      "[[body]]\nname = \"flying\"\nspacing_mm = 10\nmaterial = \"m\"\nvelocity_m_per_s = [0, 0, 1]\n" +
      Recipe::sphere(30);
  World world(scene_of(recipe));
  Appearance appearance(world, std::nullopt);
  EXPECT_EQ(appearance.write_blocks([](const VertexBlock&) {}), 2);
  world.frame({});
  EXPECT_EQ(appearance.write_blocks([](const VertexBlock& block) {
    EXPECT_EQ(block.body, 1u);
    EXPECT_EQ(block.flags[0], 0);
  }),
            1);
}

TEST(Appearance, ShowsWhatHasYieldedAndBroken) {
  Recipe recipe;
  recipe.body = "velocity_m_per_s = [0, 0, -1]";
  recipe.material += "\nyield_ratio = 1.01\nbreak_ratio = 1.15";
  recipe.world = floor_at(-21);
  recipe.physics = "safety = 0.3";
  World world(scene_of(recipe));
  Appearance appearance(world, std::nullopt);
  appearance.write_surfaces([](const BodySurface&) {});
  const auto facets_before = appearance.facets_visible();
  for (int n = 0; n < 120; ++n) world.frame({});
  EXPECT_TRUE(appearance.poll());
  std::uint32_t revision = 0;
  appearance.write_surfaces([&](const BodySurface& chunk) { revision = chunk.revision; });
  EXPECT_EQ(revision, 2u);
  EXPECT_NE(appearance.facets_visible(), facets_before);
  int yielded = 0, broken = 0;
  appearance.write_blocks([&](const VertexBlock& block) {
    EXPECT_EQ(block.revision, 2u);
    for (std::uint32_t n = 0; n < block.n_vertices; ++n) {
      yielded += (block.flags[n] & vertex_yielded) != 0 ? 1 : 0;
      broken += (block.flags[n] & vertex_broken) != 0 ? 1 : 0;
    }
  });
  EXPECT_GT(yielded, 0);
  EXPECT_GT(broken, 0);
}

TEST(Appearance, FollowsTheThreshold) {
  const palpate::test::ScratchFolder folder;
  write_volume(made_volume({6, 4, 4}, [](int i, int, int) { return i < 3 ? 100.F : 300.F; }),
               folder / "made.h5");
  Recipe recipe;
  recipe.lattice = "voxel";
  Scene scene = scene_of(recipe);
  scene.bodies = {volume_body(folder / "made.h5", 50, 400)};
  const World world(scene);
  Appearance appearance(world, std::nullopt);
  appearance.write_surfaces([](const BodySurface&) {});
  EXPECT_EQ(appearance.facets_visible(), 2u * (16 + 24 + 24));
  const auto total = appearance.facets_total();
  appearance.set_threshold(200);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!appearance.poll() && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(appearance.facets_visible(), 2u * (16 + 12 + 12));
  EXPECT_LT(appearance.facets_total(), total);
  std::uint32_t revision = 0;
  appearance.write_surfaces([&](const BodySurface& chunk) { revision = chunk.revision; });
  EXPECT_EQ(revision, 2u);
}

}  // namespace
}  // namespace palpate::physics
