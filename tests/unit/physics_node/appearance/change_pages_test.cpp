// Pages that only grow, and one after the other.
#include "physics_node/appearance/change_pages.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

/// Vertices that carry their number, and facets theirs.
struct Listing {
  std::vector<Array3f> vertices;
  std::vector<FacetChange> facets;
};
Listing listing(std::uint32_t& number, std::size_t vertices, std::size_t facets) {
  Listing list;
  for (std::size_t n = 0; n < vertices; ++n) list.vertices.push_back({static_cast<float>(number++), 0, 0});
  for (std::size_t n = 0; n < facets; ++n) list.facets.push_back({number++, {}, 0});
  return list;
}

TEST(ChangePages, HoldAllThatWasAddedInOrderWhateverWasWrittenLast) {
  test::Dice dice(5);
  ChangePages pages;
  pages.begin(3, 7, 1000);
  std::map<std::uint32_t, SurfaceChange> last;  // of each page, as a reader finds it that comes late
  Listing all;
  std::uint32_t number = 0;
  for (std::uint32_t change = 1; change <= 60; ++change) {
    const auto more = listing(number, static_cast<std::size_t>(dice.between(0, change % 3 == 0 ? 60 : 3)),
                              static_cast<std::size_t>(dice.between(0, change % 5 == 0 ? 300 : 9)));
    all.vertices.insert(all.vertices.end(), more.vertices.begin(), more.vertices.end());
    all.facets.insert(all.facets.end(), more.facets.begin(), more.facets.end());
    int written = 0;
    const int told =
        pages.add(more.vertices, more.facets, {change, 2 * change}, [&](const SurfaceChange& page) {
          ++written;
          EXPECT_EQ(page.change, change);
          const auto before = last.find(page.page);
          const bool only_totals = more.vertices.empty() && more.facets.empty();
          if (before != last.end() && !only_totals) {
            EXPECT_LT(before->second.n_vertices + before->second.n_changes, page.n_vertices + page.n_changes)
                << "written again, and nothing is new";
          }
          last[page.page] = page;
        });
    EXPECT_EQ(told, written);
    EXPECT_LE(last.size(), ChangePages::most_pages(all.vertices.size(), all.facets.size()));
    Listing read;
    for (const auto& [n, page] : last) {
      ASSERT_EQ(page.first_vertex, 1000 + read.vertices.size());
      ASSERT_EQ(page.first_change, read.facets.size());
      read.vertices.insert(read.vertices.end(), page.position.begin(),
                           page.position.begin() + page.n_vertices);
      read.facets.insert(read.facets.end(), page.facets.begin(), page.facets.begin() + page.n_changes);
    }
    ASSERT_EQ(read.vertices, all.vertices);
    ASSERT_EQ(read.facets.size(), all.facets.size());
    for (std::size_t n = 0; n < read.facets.size(); ++n) ASSERT_EQ(read.facets[n].facet, all.facets[n].facet);
    const SurfaceChange& end = last.rbegin()->second;
    EXPECT_EQ(end.total_vertices, 1000 + all.vertices.size());
    EXPECT_EQ(end.total_changes, all.facets.size());
    EXPECT_EQ(end.total_facets, change);
    EXPECT_EQ(end.facets_hidden, 2 * change);
    EXPECT_EQ(end.body, 3u);
    EXPECT_EQ(end.revision, 7u);
  }
}

TEST(ChangePages, BeginAnewWithASurface) {
  ChangePages pages;
  std::uint32_t number = 0, n_pages = 0;
  const auto some = listing(number, 5, 100);
  pages.begin(0, 1, 10);
  pages.add(some.vertices, some.facets, {}, [&](const SurfaceChange&) { ++n_pages; });
  EXPECT_EQ(n_pages, 3u);
  pages.begin(0, 2, 15);
  pages.add(some.vertices, {}, {}, [](const SurfaceChange& page) {
    EXPECT_EQ(page.revision, 2u);
    EXPECT_EQ(page.page, 0u);
    EXPECT_EQ(page.change, 1u);
    EXPECT_EQ(page.first_vertex, 15u);
    EXPECT_EQ(page.total_vertices, 20u);
    EXPECT_EQ(page.total_changes, 0u);
  });
}

}  // namespace
}  // namespace palpate::physics
