#include "render_node/model/surface_changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace palpate::render {
namespace {

constexpr std::uint32_t revision = 4;

Surface triangle() {
  Surface surface;
  surface.revision = revision;
  surface.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  surface.corners = {{0, 1, 2, 2}};
  surface.rgba = {1};
  return surface;
}

/// Pages of four changes: two of them fill the first page, and the last change takes facets away.
std::vector<SurfaceChange> four_changes() {
  std::vector<SurfaceChange> pages;
  SurfaceChange page;
  page.revision = revision;
  page.first_vertex = page.total_vertices = 3;
  const auto write = [&](std::uint32_t vertices, std::uint32_t facets) {
    ++page.change;
    page.total_vertices += vertices;
    page.total_changes += facets;
    page.total_facets = 1 + page.total_changes;
    const auto fill = [&] {
      for (; vertices > 0 && page.n_vertices < max_change_vertices; --vertices, ++page.n_vertices)
        page.position[page.n_vertices] = {static_cast<float>(page.first_vertex + page.n_vertices), 0, 0};
      for (; facets > 0 && page.n_changes < max_change_facets; --facets) {
        const std::uint32_t f = page.first_change + page.n_changes;
        page.facets[page.n_changes++] = {f + 1, {f % 3, 1, page.total_vertices - 1, 2}, f};
      }
      pages.push_back(page);
    };
    for (fill(); vertices + facets > 0; fill()) {
      ++page.page;
      page.first_vertex += page.n_vertices;
      page.first_change += page.n_changes;
      page.n_vertices = page.n_changes = 0;
    }
  };
  write(2, 10);
  write(30, 60);
  write(0, 5);
  write(1, 0);
  pages.back().total_facets = 20;
  return pages;
}

struct Reader {
  std::shared_ptr<MemoryBudget> budget = std::make_shared<MemoryBudget>();
  SurfaceChanges changes{budget};
  MemoryHold memory{budget};
  Surface surface = triangle();

  ChunkFate take(const SurfaceChange& page) {
    const auto fate = changes.take(page);
    return fate == ChunkFate::kept ? changes.carry_out(surface, memory) : fate;
  }
};

Surface end_of_all() {
  Reader reader;
  for (const auto& page : four_changes()) reader.take(page);
  return reader.surface;
}

void expect_same(const Surface& a, const Surface& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.rgba, b.rgba);
}

TEST(SurfaceChanges, MakeEachChangeWhenItsLastPageIsThere) {
  const auto pages = four_changes();
  Reader reader;
  std::vector<std::size_t> facets;
  for (const auto& page : pages) {
    const bool last = &page == &pages.back() || (&page + 1)->change > page.change;
    EXPECT_EQ(reader.take(page), last ? ChunkFate::completed : ChunkFate::kept);
    if (last) facets.push_back(reader.surface.corners.size());
  }
  EXPECT_EQ(facets, (std::vector<std::size_t>{11, 71, 76, 20}));
  EXPECT_EQ(reader.surface.position.size(), 36U);
  EXPECT_EQ(reader.surface.position[35][0], 35.0F);
  EXPECT_EQ(reader.surface.rgba[19], 18U);
  EXPECT_EQ(reader.budget->used, 33 * sizeof(Array3f) + 75 * (sizeof(Corners) + 4));
}

TEST(SurfaceChanges, AreTheSameInAnyOrder) {
  const Surface expected = end_of_all();
  std::mt19937 engine(6);
  for (int run = 0; run < 200; ++run) {
    auto pages = four_changes();
    std::shuffle(pages.begin(), pages.end(), engine);
    Reader reader;
    std::size_t facets = 1;
    for (const auto& page : pages) {
      if (reader.take(page) == ChunkFate::completed) facets = reader.surface.corners.size();
      EXPECT_EQ(reader.surface.corners.size(), facets) << "half a change";
    }
    expect_same(reader.surface, expected);
  }
}

TEST(SurfaceChanges, GiveALateReaderAllByTheLastOfEachPage) {
  std::map<std::uint32_t, SurfaceChange> last;
  for (const auto& page : four_changes()) last[page.page] = page;
  Reader reader;
  int completed = 0;
  for (const auto& [n, page] : last) completed += reader.take(page) == ChunkFate::completed ? 1 : 0;
  EXPECT_EQ(completed, 1);
  expect_same(reader.surface, end_of_all());
}

/// A page that is full is not written again, however much comes after it.
TEST(SurfaceChanges, GoOnWithTheNextPageWhereTheLastOneIsFull) {
  SurfaceChange page;
  page.revision = revision;
  page.change = 1;
  page.first_vertex = page.total_vertices = 3;
  page.n_changes = page.total_changes = max_change_facets;
  for (std::uint32_t n = 0; n < page.n_changes; ++n) page.facets[n] = {n + 1, {0, 1, 2, 2}, n};
  page.total_facets = max_change_facets + 1;
  Reader reader;
  EXPECT_EQ(reader.take(page), ChunkFate::completed);
  SurfaceChange next;
  next.revision = revision;
  next.change = 2;
  next.page = 1;
  next.first_vertex = next.total_vertices = 3;
  next.first_change = max_change_facets;
  next.n_changes = 1;
  next.total_changes = max_change_facets + 1;
  next.facets[0] = {7, {2, 1, 0, 0}, 99};
  next.total_facets = page.total_facets;
  EXPECT_EQ(reader.take(next), ChunkFate::completed);
  EXPECT_EQ(reader.surface.rgba[7], 99U);
}

TEST(SurfaceChanges, WaitForTheirSurface) {
  Reader reader;
  reader.surface.revision = revision - 1;
  for (const auto& page : four_changes()) EXPECT_EQ(reader.take(page), ChunkFate::kept);
  expect_same(reader.surface, triangle());
  reader.surface = triangle();
  EXPECT_EQ(reader.changes.carry_out(reader.surface, reader.memory), ChunkFate::completed);
  expect_same(reader.surface, end_of_all());
}

TEST(SurfaceChanges, IgnoreWhatIsDoneAndWhatIsOfAnOlderSurface) {
  const auto pages = four_changes();
  Reader reader;
  for (const auto& page : pages) reader.take(page);
  for (const auto& page : pages) EXPECT_EQ(reader.take(page), ChunkFate::stale);
  auto older = pages[0];
  older.revision = revision - 1;
  EXPECT_EQ(reader.take(older), ChunkFate::stale);
  auto newer = pages[0];
  newer.revision = revision + 1;
  EXPECT_EQ(reader.take(newer), ChunkFate::kept);
  expect_same(reader.surface, end_of_all());
}

TEST(SurfaceChanges, RefuseWhatNoSurfaceCanBecome) {
  const auto fate_of = [](auto spoil) {
    Reader reader;
    auto page = four_changes()[0];
    spoil(page);
    const auto fate = reader.take(page);
    if (fate == ChunkFate::malformed) {
      expect_same(reader.surface, triangle());
      EXPECT_EQ(reader.take(four_changes()[0]), ChunkFate::stale) << "nothing more of this revision";
      EXPECT_EQ(reader.budget->used, 0U);
    }
    return fate;
  };
  EXPECT_EQ(fate_of([](SurfaceChange&) {}), ChunkFate::completed);
  EXPECT_EQ(fate_of([](SurfaceChange& p) { p.facets[3].facet = 5; }), ChunkFate::malformed) << "a gap";
  EXPECT_EQ(fate_of([](SurfaceChange& p) { p.facets[3].corners[2] = 5; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](SurfaceChange& p) { p.total_facets = 12; }), ChunkFate::malformed);
  EXPECT_EQ(fate_of([](SurfaceChange& p) { p.n_vertices = 0, p.first_vertex = p.total_vertices = 2; }),
            ChunkFate::malformed)
      << "fewer vertices than there are";
  EXPECT_EQ(fate_of([](SurfaceChange& p) { ++p.first_change, ++p.total_changes; }), ChunkFate::kept)
      << "the first change is still to come";
}

/// DDS keeps pages of a surface that has been sent whole since, and gives them to who comes late.
TEST(SurfaceChanges, LetGoOfPagesWhenANewerSurfaceIsThere) {
  Reader reader;
  reader.surface.revision = revision - 1;
  for (const auto& page : four_changes()) EXPECT_EQ(reader.take(page), ChunkFate::kept);
  EXPECT_GT(reader.budget->used, 0U);
  reader.surface = triangle();
  reader.surface.revision = revision + 1;
  EXPECT_EQ(reader.changes.carry_out(reader.surface, reader.memory), ChunkFate::kept);
  EXPECT_EQ(reader.budget->used, 0U);
  EXPECT_EQ(reader.take(four_changes()[0]), ChunkFate::stale);
  expect_same(reader.surface, triangle());
}

/// A page of 1.3 kB that says it is one of 16,384.
TEST(SurfaceChanges, TakeMemoryForWhatHasComeAndNoMoreThanTheirBudget) {
  Reader reader;
  auto page = four_changes()[0];
  page.total_changes = max_change_pages * max_change_facets;
  EXPECT_EQ(reader.take(page), ChunkFate::kept);
  EXPECT_LE(reader.budget->used, sizeof page + 100);
  std::vector<std::unique_ptr<SurfaceChanges>> others;
  ChunkFate fate = ChunkFate::kept;
  while (fate == ChunkFate::kept && others.size() < 100) {
    others.push_back(std::make_unique<SurfaceChanges>(reader.budget));
    for (page.page = 1; page.page < max_change_pages && fate == ChunkFate::kept; ++page.page)
      fate = others.back()->take(page);
  }
  EXPECT_EQ(fate, ChunkFate::too_large);
  EXPECT_LE(reader.budget->used, MemoryBudget::most);
  for (auto& one : others) one->begin_anew();
  reader.changes.begin_anew();
  EXPECT_EQ(reader.budget->used, 0U);
}

}  // namespace
}  // namespace palpate::render
