#include "render_node/model/surface_assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

using test::chunks_of;
using test::cube_surface;

// 26 x 26 x 26 cells: 4,058 vertices, 4,056 facets, so two chunks.
const auto cube = cube_surface(26, 0.1, 0xff8090a0U);

TEST(SurfaceAssembly, PutsChunksTogetherInAnyOrder) {
  auto chunks = chunks_of(cube, 3, 1);
  ASSERT_GE(chunks.size(), 2U);
  std::reverse(chunks.begin(), chunks.end());
  SurfaceAssembly assembly;
  for (std::size_t i = 0; i + 1 < chunks.size(); ++i) EXPECT_EQ(assembly.take(chunks[i]), ChunkFate::kept);
  ASSERT_EQ(assembly.take(chunks.back()), ChunkFate::completed);
  const Surface surface = assembly.finished();
  EXPECT_EQ(surface.body, 3U);
  EXPECT_EQ(surface.revision, 1U);
  EXPECT_EQ(surface.position, cube.position);
  EXPECT_EQ(surface.corners, cube.corners);
  EXPECT_EQ(surface.rgba, cube.rgba);
  EXPECT_EQ(surface.facets_hidden, cube.facets_hidden);
}

TEST(SurfaceAssembly, IsNotMisledByAChunkThatComesTwice) {
  const auto chunks = chunks_of(cube, 0, 1);
  SurfaceAssembly assembly;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(assembly.take(chunks[0]), ChunkFate::kept);
  EXPECT_EQ(assembly.take(chunks[1]), ChunkFate::completed);
}

TEST(SurfaceAssembly, IgnoresWhatIsShownAlreadyAndWhatIsOlder) {
  SurfaceAssembly assembly;
  for (const auto& chunk : chunks_of(cube, 0, 5)) assembly.take(chunk);
  assembly.finished();
  EXPECT_EQ(assembly.take(chunks_of(cube, 0, 5)[0]), ChunkFate::stale);
  EXPECT_EQ(assembly.take(chunks_of(cube, 0, 4)[0]), ChunkFate::stale);
  EXPECT_EQ(assembly.take(chunks_of(cube, 0, 7)[0]), ChunkFate::kept);
  EXPECT_EQ(assembly.take(chunks_of(cube, 0, 6)[0]), ChunkFate::stale);
}

TEST(SurfaceAssembly, DropsAnUnfinishedRevisionForANewerOne) {
  SurfaceAssembly assembly;
  const auto one = chunks_of(cube, 0, 1), two = chunks_of(cube, 0, 2);
  EXPECT_EQ(assembly.take(one[0]), ChunkFate::kept);
  EXPECT_EQ(assembly.take(two[1]), ChunkFate::kept);  // not completed: chunk 0 was of revision 1
  EXPECT_EQ(assembly.take(one[1]), ChunkFate::stale);
  EXPECT_EQ(assembly.take(two[0]), ChunkFate::completed);
}

TEST(SurfaceAssembly, RefusesChunksThatBreakTheirPromises) {
  const BodySurface good = chunks_of(cube, 0, 1)[0];
  const auto fate_of = [&](auto spoil) {
    BodySurface chunk = good;
    spoil(chunk);
    SurfaceAssembly assembly;
    return assembly.take(chunk);
  };
  EXPECT_EQ(fate_of([](BodySurface&) {}), ChunkFate::kept);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.revision = 0; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.chunk = c.n_chunks; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.n_chunks = 0; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.n_chunks = 0xffffffffU; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.n_vertices = max_surface_vertices + 1; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.first_vertex = c.total_vertices; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.first_facet = 0xffffffffU; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.total_vertices = 0xffffffffU; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.corners[7][2] = c.total_vertices; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](BodySurface& c) { c.position[9][1] = std::numeric_limits<float>::quiet_NaN(); }),
            ChunkFate::malformed);
}

TEST(SurfaceAssembly, RefusesAChunkThatDisagreesWithItsFellows) {
  auto chunks = chunks_of(cube, 0, 1);
  SurfaceAssembly assembly;
  assembly.take(chunks[0]);
  chunks[1].total_facets -= 1;
  chunks[1].n_facets -= 1;
  EXPECT_EQ(assembly.take(chunks[1]), ChunkFate::malformed);
}

/// A chunk of 65 kB that says it is the first of 16,384.
TEST(SurfaceAssembly, TakesMemoryForWhatHasComeOnly) {
  BodySurface chunk = chunks_of(cube, 0, 1)[0];
  chunk.n_chunks = max_surface_chunks;
  chunk.total_vertices = max_surface_chunks * max_surface_vertices;
  chunk.total_facets = max_surface_chunks * max_surface_facets;
  const auto budget = std::make_shared<MemoryBudget>();
  SurfaceAssembly assembly(budget);
  for (std::uint32_t revision = 1; revision < 100; ++revision) {
    chunk.revision = revision;
    ASSERT_EQ(assembly.take(chunk), ChunkFate::kept);
    EXPECT_LE(budget->used, sizeof chunk + 100);
  }
  assembly.begin_anew();
  EXPECT_EQ(budget->used, 0U);
}

TEST(SurfaceAssembly, StopsAtItsBudgetWhateverIsSaidToCome) {
  BodySurface chunk = chunks_of(cube, 0, 1)[0];
  chunk.n_chunks = max_surface_chunks;
  chunk.total_vertices = max_surface_chunks * max_surface_vertices;
  chunk.total_facets = max_surface_chunks * max_surface_facets;
  const auto budget = std::make_shared<MemoryBudget>();
  SurfaceAssembly one(budget), other(budget);
  std::uint32_t kept = 0;
  while (kept < chunk.n_chunks && one.take(chunk) == ChunkFate::kept) chunk.chunk = ++kept;
  EXPECT_LT(kept, chunk.n_chunks);
  EXPECT_EQ(one.take(chunk), ChunkFate::too_large);
  EXPECT_LE(budget->used, MemoryBudget::most);
  EXPECT_EQ(other.take(chunk), ChunkFate::too_large) << "all bodies share it";
  one.begin_anew();
  EXPECT_EQ(other.take(chunk), ChunkFate::kept);
  EXPECT_GE(budget->refused, 2U);
}

TEST(SurfaceAssembly, RefusesChunksThatDoNotMakeAWhole) {
  auto chunks = chunks_of(cube, 0, 1);
  chunks[1].first_vertex = 0;
  SurfaceAssembly assembly;
  assembly.take(chunks[0]);
  EXPECT_EQ(assembly.take(chunks[1]), ChunkFate::malformed);
  chunks = chunks_of(cube, 0, 1);
  assembly.take(chunks[0]);
  EXPECT_EQ(assembly.take(chunks[1]), ChunkFate::completed) << "as if it had not been";
}

}  // namespace
}  // namespace palpate::render
