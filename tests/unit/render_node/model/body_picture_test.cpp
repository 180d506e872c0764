#include "render_node/model/body_picture.h"

#include <gtest/gtest.h>

#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

using test::block_of;
using test::chunks_of;
using test::cube_surface;

const auto cube = cube_surface(26, 0.1, 0xff8090a0U);

BodyPicture picture_of(std::uint32_t revision) {
  BodyPicture picture;
  for (const auto& chunk : chunks_of(cube, 0, revision)) picture.take(chunk);
  picture.refresh();
  return picture;
}

TEST(BodyPicture, KeepsTheOldPictureUntilTheNewOneIsWhole) {
  BodyPicture picture = picture_of(1);
  const auto smaller = cube_surface(20, 0.05, 0xff0000ffU);
  const auto chunks = chunks_of(smaller, 0, 2);
  ASSERT_EQ(chunks.size(), 2U);
  picture.take(chunks[1]);
  EXPECT_EQ(picture.surface().revision, 1U);
  EXPECT_EQ(picture.surface().position, cube.position);
  picture.take(chunks[0]);
  EXPECT_EQ(picture.surface().revision, 2U);
  EXPECT_EQ(picture.facets_visible(), smaller.corners.size());
  EXPECT_EQ(picture.facets_total(), smaller.corners.size() + smaller.facets_hidden);
}

TEST(BodyPicture, MovesVerticesOfTheRevisionShownOnly) {
  BodyPicture picture = picture_of(2);
  auto block = block_of(cube, 0, 2, 1);
  block.position[5][2] += 0.01F;
  block.flags[6] = vertex_yielded;
  EXPECT_TRUE(picture.take(block));
  const auto v = std::size_t{max_block_vertices} + 5;
  EXPECT_EQ(picture.surface().position[v], block.position[5]);
  picture.refresh();
  EXPECT_EQ(picture.packed()[v + 1].flags, vertex_yielded);

  block.position[5][2] += 0.01F;
  block.revision = 1;
  EXPECT_FALSE(picture.take(block));
  block.revision = 3;
  EXPECT_TRUE(picture.take(block)) << "held";
  EXPECT_NE(picture.surface().position[v], block.position[5]);
}

TEST(BodyPicture, TakesTheFirstRevisionOfAPhysicsThatWasStartedAgain) {
  BodyPicture picture = picture_of(5);
  const auto smaller = cube_surface(20, 0.05, 0xff0000ffU);
  const auto chunks = chunks_of(smaller, 0, 1);
  ASSERT_EQ(chunks.size(), 2U);
  EXPECT_EQ(picture.take(chunks[0]), ChunkFate::stale) << "as long as nobody says that it is another one";
  picture.begin_anew();
  EXPECT_EQ(picture.take(chunks[1]), ChunkFate::kept);
  EXPECT_EQ(picture.surface().position, cube.position) << "the old picture stays until the new one is whole";
  auto block = block_of(smaller, 0, 1, 0);
  block.position[5][2] += 0.01F;
  EXPECT_TRUE(picture.take(block)) << "held";
  EXPECT_EQ(picture.take(chunks[0]), ChunkFate::completed);
  EXPECT_EQ(picture.facets_visible(), smaller.corners.size());
  EXPECT_EQ(picture.surface().position[5], block.position[5]);
  EXPECT_EQ(picture.take(chunks_of(cube, 0, 1)[0]), ChunkFate::stale) << "and then as ever";
}

TEST(BodyPicture, KeepsABlockThatOvertakesItsSurface) {
  BodyPicture picture = picture_of(1);
  const auto chunks = chunks_of(cube, 0, 2);
  picture.take(chunks[0]);
  auto block = block_of(cube, 0, 2, 0);
  block.position[3][0] += 0.02F;
  EXPECT_TRUE(picture.take(block));
  EXPECT_EQ(picture.surface().position[3], cube.position[3]);
  picture.take(chunks[1]);
  EXPECT_EQ(picture.surface().position[3], block.position[3]);
}

TEST(BodyPicture, KeepsABlockThatComesBeforeAnyOfItsSurface) {
  BodyPicture picture = picture_of(1);
  auto block = block_of(cube, 0, 3, 0);
  block.flags[3] = vertex_yielded;
  EXPECT_TRUE(picture.take(block));
  block.revision = 2;
  EXPECT_FALSE(picture.take(block)) << "older than one that is held";
  for (const std::uint32_t revision : {2U, 3U}) {
    for (const auto& chunk : chunks_of(cube, 0, revision)) picture.take(chunk);
    picture.refresh();
    EXPECT_EQ(picture.packed()[3].flags, revision == 3 ? vertex_yielded : 0);
  }
}

TEST(BodyPicture, KnowsHowFarVerticesAreFromRest) {
  BodyPicture picture;
  auto ahead = block_of(cube, 0, 1, 0);
  ahead.position[7][1] += 0.003F;
  picture.take(ahead);  // before its surface, which says where it lies at rest
  for (const auto& chunk : chunks_of(cube, 0, 1)) picture.take(chunk);
  EXPECT_NEAR(picture.farthest(), 0.003F, 1e-6F);
  EXPECT_EQ(picture.rest(), cube.position);
  ahead.position[7] = cube.position[7];
  ahead.position[8][0] -= 0.001F;
  picture.take(ahead);
  EXPECT_NEAR(picture.farthest(), 0.001F, 1e-6F);
}

TEST(BodyPicture, DoesNotCountElementsAndMassesAsFacets) {
  auto with_loose = cube_surface(2, 0.1, 0xff0000ffU);
  const std::size_t facets = with_loose.corners.size();
  with_loose.corners.push_back({0, 1, 1, 1});
  with_loose.corners.push_back({5, 5, 5, 5});
  with_loose.rgba.insert(with_loose.rgba.end(), 2, 0xff0000ffU);
  BodyPicture picture;
  for (const auto& chunk : chunks_of(with_loose, 0, 1)) picture.take(chunk);
  EXPECT_EQ(picture.facets_visible(), facets);
  EXPECT_NEAR(picture.edge_length(), 0.05, 1e-7);
}

/// One facet that is new, at three new vertices.
SurfaceChange growth_of(std::uint32_t revision) {
  SurfaceChange page;
  page.revision = revision;
  page.change = 1;
  page.first_vertex = static_cast<std::uint32_t>(cube.position.size());
  page.n_vertices = 3;
  page.total_vertices = page.first_vertex + 3;
  page.position = {Array3f{0, 0, 1}, Array3f{0.1F, 0, 1}, Array3f{0, 0.1F, 1}};
  const auto n = static_cast<std::uint32_t>(cube.corners.size());
  page.n_changes = page.total_changes = 1;
  page.facets[0] = {
      n, {page.first_vertex, page.first_vertex + 1, page.first_vertex + 2, page.first_vertex + 2}, 0};
  page.total_facets = n + 1;
  return page;
}

TEST(BodyPicture, HoldsABlockOfVerticesThatAreStillToCome) {
  BodyPicture picture = picture_of(1);
  auto block = block_of(cube, 0, 1, 1);
  block.n_vertices += 3;
  const std::size_t last = block.n_vertices - 1;
  block.position[last] = {7, 8, 9};
  block.flags[last] = vertex_broken;
  block.position[0] = {1, 2, 3};
  EXPECT_TRUE(picture.take(block));
  EXPECT_EQ(picture.surface().position[max_block_vertices], cube.position[max_block_vertices]);
  EXPECT_EQ(picture.take(growth_of(1)), ChunkFate::completed);
  picture.refresh();
  EXPECT_EQ(picture.surface().position.back(), block.position[last]);
  EXPECT_EQ(picture.surface().position[max_block_vertices], block.position[0]);
  EXPECT_EQ(picture.packed().back().flags, vertex_broken);
  EXPECT_EQ(picture.facets_visible(), cube.corners.size() + 1);
}

TEST(BodyPicture, KeepsWhereVerticesAreWhenFacetsChange) {
  BodyPicture picture = picture_of(1);
  auto block = block_of(cube, 0, 1, 0);
  block.position[5] = {1, 2, 3};
  block.flags[5] = vertex_yielded;
  picture.take(block);
  picture.take(growth_of(1));
  picture.refresh();
  EXPECT_EQ(picture.surface().position[5], block.position[5]);
  EXPECT_EQ(picture.packed()[5].flags, vertex_yielded);
  EXPECT_TRUE(picture.all_dirty());
}

TEST(BodyPicture, MakesNoChangeToTheSurfaceOfAPhysicsThatIsGone) {
  BodyPicture picture = picture_of(1);
  picture.begin_anew();
  EXPECT_EQ(picture.take(growth_of(1)), ChunkFate::kept);
  EXPECT_EQ(picture.surface().corners, cube.corners);
  for (const auto& chunk : chunks_of(cube, 0, 1)) picture.take(chunk);
  EXPECT_EQ(picture.facets_visible(), cube.corners.size() + 1) << "but to that of the one that sent it";
}

TEST(BodyPicture, MarksOnlyTheNeighbourhoodOfWhatMoved) {
  BodyPicture picture = picture_of(1);
  EXPECT_TRUE(picture.all_dirty());
  picture.clear_dirty();
  EXPECT_TRUE(picture.dirty_ranges().empty());
  picture.take(block_of(cube, 0, 1, 0));  // nothing moved
  picture.refresh();
  EXPECT_TRUE(picture.dirty_ranges().empty());
  auto block = block_of(cube, 0, 1, 0);
  block.position[100][1] += 0.001F;
  picture.take(block);
  picture.refresh();
  EXPECT_FALSE(picture.all_dirty());
  std::size_t n = 0;
  bool holds_it = false;
  for (const auto& range : picture.dirty_ranges()) {
    n += range.n;
    holds_it |= range.first <= 100 && 100 < range.first + range.n;
  }
  EXPECT_TRUE(holds_it);
  EXPECT_LT(n, cube.position.size());
}

TEST(BodyPicture, GivesAVertexTheMeanColourOfItsFacets) {
  auto coloured = cube_surface(1, 1.0, 0xff000000U);
  coloured.rgba = {0xff0000ffU, 0xff0000ffU, 0xff00ff00U, 0xff00ff00U, 0xffff0000U, 0xffff0000U};
  BodyPicture picture;
  for (const auto& chunk : chunks_of(coloured, 0, 1)) picture.take(chunk);
  for (const auto rgba : picture.vertex_rgba())
    EXPECT_EQ(rgba, 0xff555555U);  // one facet of each at every corner
}

TEST(BodyPicture, HoldsBlocksThatWaitWithinItsBudget) {
  const auto budget = std::make_shared<MemoryBudget>();
  BodyPicture picture(budget);
  VertexBlock block = block_of(cube, 0, 2, 0);
  std::uint32_t held = 0;
  while (held < max_surface_chunks && picture.take(block)) {
    block.block = ++held;
    block.first_vertex = held * max_block_vertices;
  }
  EXPECT_LT(held, max_surface_chunks);
  EXPECT_LE(budget->used, MemoryBudget::most);
  picture.begin_anew();
  EXPECT_EQ(budget->used, 0U);
}

}  // namespace
}  // namespace palpate::render
