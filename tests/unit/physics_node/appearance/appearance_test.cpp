#include "physics_node/appearance/appearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <thread>

#include "common/scene/body_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/appearance/colours.h"
#include "physics_node/step/body_model.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

using namespace test;

/// Tells nobody.
SurfaceSinks no_sinks() {
  return {[](const BodySurface&) {}, [](const SurfaceChange&) {}};
}
/// Of whole surfaces only.
SurfaceSinks whole_to(const std::function<void(const BodySurface&)>& sink) {
  return {sink, [](const SurfaceChange&) { ADD_FAILURE() << "a change"; }};
}
/// Of changes only.
SurfaceSinks changes_to(const std::function<void(const SurfaceChange&)>& sink) {
  return {[](const BodySurface&) { ADD_FAILURE() << "a whole surface"; }, sink};
}

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
  const int written = appearance.write_surfaces(whole_to([&](const BodySurface& chunk) {
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
  }));
  EXPECT_GT(n_chunks, 1u);
  EXPECT_EQ(written, static_cast<int>(n_chunks));
  EXPECT_EQ(facets.size(), 2u * (32 * 32 + 2 * 32 * 15));
  EXPECT_EQ(facets.size(), appearance.facets_visible());
  for (const int n : vertices) ASSERT_EQ(n, 1);
  for (const int n : facets) ASSERT_EQ(n, 1);
  EXPECT_FALSE(appearance.poll());
  EXPECT_EQ(appearance.write_surfaces(changes_to([](const SurfaceChange&) { ADD_FAILURE(); })), 0);
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

/// A reader has lost a part of it.
TEST(Appearance, SendsABodyWholeAgainOnRequest) {
  const World world(scene_of(large_slab()));
  Appearance appearance(world, std::nullopt);
  appearance.poll();
  const int chunks = appearance.write_surfaces(no_sinks());
  ASSERT_FALSE(appearance.poll());
  appearance.publish_anew(0);
  EXPECT_TRUE(appearance.poll());
  std::uint32_t revision = 0;
  EXPECT_EQ(appearance.write_surfaces(whole_to([&](const BodySurface& chunk) { revision = chunk.revision; })),
            chunks);
  EXPECT_EQ(revision, 2u);
  EXPECT_EQ(appearance.write_blocks([](const VertexBlock& block) { EXPECT_EQ(block.revision, 2u); }), 2);
  EXPECT_FALSE(appearance.poll());
}

TEST(Appearance, LeavesABodyAtRestAlone) {
  Recipe recipe;
  recipe.world =
      "[[body]]\nname = \"flying\"\nspacing_mm = 10\nmaterial = \"m\"\n"
      "at_mm = [500, 0, 0]\nvelocity_m_per_s = [0, 0, 1]\n" +
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

/// A cube that breaks on a floor.
Recipe falling(const std::string& lattice) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.body = "velocity_m_per_s = [0, 0, -1]";
  recipe.material += "\nyield_ratio = 1.01\nbreak_ratio = 1.15";
  recipe.world = floor_at(-21);
  recipe.physics = "safety = 0.3";
  return recipe;
}

class BrokenAppearance : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Lattices, BrokenAppearance, testing::Values("fcc", "voxel"));

TEST_P(BrokenAppearance, ShowsWhatHasYieldedAndBroken) {
  World world(scene_of(falling(GetParam())));
  Appearance appearance(world, std::nullopt);
  appearance.write_surfaces(no_sinks());
  const auto facets_before = appearance.facets_visible();
  for (int n = 0; n < 120; ++n) world.frame({});
  EXPECT_TRUE(appearance.poll());
  int pages = 0;
  appearance.write_surfaces(changes_to([&](const SurfaceChange& page) {
    ++pages;
    EXPECT_EQ(page.revision, 1u);
    EXPECT_EQ(page.change, 1u);
  }));
  EXPECT_GT(pages, 0);
  EXPECT_NE(appearance.facets_visible(), facets_before);
  int yielded = 0, broken = 0, dark = 0;
  appearance.write_blocks([&](const VertexBlock& block) {
    EXPECT_EQ(block.revision, 1u);
    for (std::uint32_t n = 0; n < block.n_vertices; ++n) {
      yielded += (block.flags[n] & vertex_yielded) != 0 ? 1 : 0;
      dark += block.flags[n] >= 63 * vertex_share_one ? 1 : 0;
      EXPECT_TRUE((block.flags[n] & vertex_yielded) != 0 || block.flags[n] < vertex_share_one);
      broken += (block.flags[n] & vertex_broken) != 0 ? 1 : 0;
    }
  });
  EXPECT_GE(yielded, dark);
  EXPECT_GT(dark, 0);
  EXPECT_GT(broken, 0);
}

TEST(YieldedShare, CountsLiveElements) {
  // A mass pushed along x by 0.3 L: of its twelve elements the four behind it are stretched by more than a tenth.
  Recipe recipe;
  recipe.shape = Recipe::box(90, 90, 90);
  recipe.material += "\nyield_ratio = 1.1\nbreak_ratio = 1.5";
  const auto moving = make_body_model(body_of(recipe), Precision::double_);
  const Lattice& lattice = moving->body().lattice;
  const Index pushed = lattice.mass_at({4, 4, 4}), behind = lattice.mass_at({3, 4, 3});
  const auto strain = [&](double share) {
    moving->place(pushed, Vec3(share * lattice.rest_length[0], 0, 0), Vec3::Zero());
    moving->advance({.dt = 1e-9, .watch = true}, {});
  };
  const auto share_of = [&](Index cell) {
    Condition condition;
    moving->conditions({&cell, 1}, {&condition, 1});
    return condition.yielded_share;
  };
  EXPECT_EQ(share_of(pushed), 0);
  strain(0.3);
  EXPECT_DOUBLE_EQ(share_of(pushed), 4.0 / 12);
  EXPECT_DOUBLE_EQ(share_of(behind), 1.0 / 12);
  EXPECT_EQ(share_of(lattice.mass_at({5, 4, 5})), 0) << "compressed";
  strain(0.8);  // those four break, four across are stretched by 1.28
  EXPECT_DOUBLE_EQ(share_of(pushed), 4.0 / 8);
  EXPECT_EQ(share_of(behind), 0);
}

TEST_P(BrokenAppearance, IsWholeAgainAfterAReset) {
  World world(scene_of(falling(GetParam())));
  Appearance appearance(world, std::nullopt);
  appearance.write_surfaces(no_sinks());
  const auto facets = appearance.facets_visible();
  for (int n = 0; n < 120; ++n) world.frame({});
  EXPECT_TRUE(appearance.poll());
  appearance.write_surfaces(no_sinks());
  EXPECT_NE(appearance.facets_visible(), facets);
  world.reset();
  EXPECT_TRUE(appearance.poll());
  EXPECT_EQ(appearance.facets_visible(), facets);
  appearance.write_surfaces(no_sinks());
  EXPECT_FALSE(appearance.poll()) << "nothing has broken since";
}

/// Facets as they are sent, whoever made them.
std::vector<std::array<std::uint32_t, 4>> sent_facets(Appearance& appearance) {
  std::vector<std::array<std::uint32_t, 4>> facets;
  appearance.write_surfaces({[&](const BodySurface& chunk) {
                               facets.insert(facets.end(), chunk.corners.begin(),
                                             chunk.corners.begin() + chunk.n_facets);
                             },
                             [&](const SurfaceChange& page) {
                               for (std::uint32_t n = 0; n < page.n_changes; ++n)
                                 facets.push_back(page.facets[n].corners);
                             }});
  return facets;
}

TEST_P(BrokenAppearance, IsTheSameFromAThreadOfItsOwn) {
  World world(scene_of(falling(GetParam())));
  Appearance at_once(world, std::nullopt), beside(world, std::nullopt, Remake::beside);
  sent_facets(at_once), sent_facets(beside);
  for (int n = 0; n < 120; ++n) world.frame({});
  EXPECT_TRUE(at_once.poll());
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!beside.poll() && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto facets = sent_facets(at_once);
  EXPECT_GT(facets.size(), 0u);
  EXPECT_EQ(facets, sent_facets(beside));
}

TEST_P(BrokenAppearance, ColoursFragmentsOnRequest) {
  const auto colours_of = [&](bool asked) {
    Recipe recipe = falling(GetParam());
    recipe.body = "velocity_m_per_s = [0, 0, -3]";
    Scene scene = scene_of(recipe);
    scene.render->show_fragments = asked;
    World world(scene);
    Appearance appearance(world, std::nullopt);
    for (int n = 0; n < 120; ++n) world.frame({});
    EXPECT_GT(world.fragments(0)->count(), 2);
    appearance.poll();
    appearance.publish_anew(0);
    std::set<std::uint32_t> colours;
    appearance.write_surfaces(whole_to([&](const BodySurface& chunk) {
      colours.insert(chunk.rgba.begin(), chunk.rgba.begin() + chunk.n_facets);
    }));
    // Every fragment is in sight, the smallest as particles; the largest keeps the colour of the body.
    const auto& masses = world.fragments(0)->masses();
    const auto largest = std::max_element(masses.begin(), masses.end()) - masses.begin();
    std::set<std::uint32_t> expected{body_colour(scene, 0)};
    for (Index label = 0; asked && label < world.fragments(0)->count(); ++label)
      if (label != largest) expected.insert(fragment_colour(label));
    EXPECT_EQ(colours, expected);
    return colours;
  };
  EXPECT_EQ(colours_of(false).size(), 1u);
  EXPECT_GT(colours_of(true).size(), 2u);
}

TEST(Colours, OfFragmentsAreApart) {
  const auto apart = [](std::uint32_t a, std::uint32_t b) {
    int sum = 0;
    for (int shift : {0, 8, 16})
      sum += std::abs(static_cast<int>(a >> shift & 0xff) - static_cast<int>(b >> shift & 0xff));
    return sum;
  };
  for (std::int32_t a = 0; a < 60; ++a)
    for (std::int32_t b = a + 1; b < a + 8; ++b)
      EXPECT_GT(apart(fragment_colour(a), fragment_colour(b)), 60) << a << " and " << b;
}

TEST(Colours, OfAToolAreThoseOfSteel) {
  Scene scene = scene_of(Recipe());
  const std::uint32_t tissue = body_colour(scene, 0);
  ToolSpec tool;
  tool.shape = ToolShape::body;
  tool.body = scene.bodies[0].name;
  scene.tools.push_back(tool);
  EXPECT_NE(body_colour(scene, 0), tissue);
}

/// Half of it is dense: a surface of its own, behind the body and its section, that moves with it; another one from another
/// intensity on; none where nobody asks.
TEST(Appearance, ShowsWhatLiesInside) {
  const palpate::test::ScratchFolder folder;
  write_volume(made_volume({6, 4, 4}, [](int i, int, int) { return i < 3 ? 100.F : 300.F; }),
               folder / "made.h5");
  Recipe recipe;
  recipe.lattice = "voxel";
  Scene scene = scene_of(recipe);
  scene.bodies = {volume_body(folder / "made.h5", 50, 400)};
  World world(scene);
  Appearance appearance(world, std::nullopt);
  const auto facets = [&] {
    std::map<std::uint32_t, std::uint32_t> of;
    appearance.write_surfaces({[&](const BodySurface& chunk) { of[chunk.body] = chunk.total_facets; },
                               [](const SurfaceChange&) {}});
    return of;
  };
  const auto all = facets();
  EXPECT_EQ(all, (std::map<std::uint32_t, std::uint32_t>{{0, 2 * (16 + 24 + 24)}}));
  const std::size_t visible = appearance.facets_visible(), total = appearance.facets_total();
  appearance.set_inside(200);
  EXPECT_EQ(facets(), (std::map<std::uint32_t, std::uint32_t>{{2, 2 * (16 + 12 + 12)}}));
  EXPECT_EQ(appearance.facets_visible(), visible);
  EXPECT_EQ(appearance.facets_total(), total);
  appearance.set_inside(50);
  EXPECT_EQ(facets(), (std::map<std::uint32_t, std::uint32_t>{{2, 2 * (16 + 24 + 24)}}));
  appearance.set_inside(std::nullopt);
  EXPECT_TRUE(facets().empty());
  appearance.publish_anew(2);
  EXPECT_TRUE(facets().empty());
  // Blocks of it are sent as the body moves.
  appearance.set_inside(200);
  facets();
  for (const Index cell : world.body(0).body().nodes())
    world.body(0).place(cell, Vec3(0.001, 0, 0), Vec3::Zero());
  std::map<std::uint32_t, int> blocks;
  appearance.write_blocks([&](const VertexBlock& block) { ++blocks[block.body]; });
  EXPECT_EQ(blocks, (std::map<std::uint32_t, int>{{0, 1}, {2, 1}}));
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
  appearance.write_surfaces(no_sinks());
  EXPECT_EQ(appearance.facets_visible(), 2u * (16 + 24 + 24));
  const auto total = appearance.facets_total();
  appearance.set_threshold(200);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!appearance.poll() && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(appearance.facets_visible(), 2u * (16 + 12 + 12));
  EXPECT_LT(appearance.facets_total(), total);
  std::uint32_t facets = 0;
  appearance.write_surfaces(changes_to([&](const SurfaceChange& page) { facets = page.total_facets; }));
  EXPECT_EQ(facets, appearance.facets_visible());
}

}  // namespace
}  // namespace palpate::physics
