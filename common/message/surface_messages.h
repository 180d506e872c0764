#pragma once
// What physics says to the eye: the surface of a body, what breaks change in it, and where its vertices are.

#include <array>
#include <cstdint>

#include "common/message/limits.h"
#include "common/message/promise.h"

namespace palpate {

/// physics -> render. One chunk of what is visible of a body: vertices where they lie at rest, and four-cornered
/// facets; where they are, VertexBlocks say. A set is complete when all n_chunks of one revision have come. A
/// triangle repeats its last corner; a facet without an area is an element (a, b, b, b) or a mass (a, a, a, a) that
/// belongs to no other facet.
struct BodySurface {
  std::uint32_t body = 0;
  std::uint32_t revision =
      0;                    // numbers vertices and facets; grows with every surface sent whole; starts at 1
  std::uint32_t chunk = 0;  // < n_chunks <= max_surface_chunks
  std::uint32_t n_chunks = 1;
  std::uint32_t total_vertices = 0;
  std::uint32_t total_facets = 0;
  std::uint32_t facets_hidden = 0;  // of the whole body: facets between two filled cells, not sent
  std::uint32_t rigid = 0;          // 1: scenery, no VertexBlock will follow
  std::uint32_t first_vertex = 0;   // of this chunk
  std::uint32_t n_vertices = 0;     // <= max_surface_vertices
  std::uint32_t first_facet = 0;
  std::uint32_t n_facets = 0;                                              // <= max_surface_facets
  std::array<Array3f, max_surface_vertices> position{};                    // at rest [m]
  std::array<std::array<std::uint32_t, 4>, max_surface_facets> corners{};  // < total_vertices
  std::array<std::uint32_t, max_surface_facets> rgba{};                    // 0xAABBGGRR

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(body), below(max_bodies));
    visit(PALPATE_FIELD(revision), from_one);
    visit(PALPATE_FIELD(chunk), any);
    visit(PALPATE_FIELD(n_chunks), count(max_surface_chunks));
    visit(PALPATE_FIELD(total_vertices), any);
    visit(PALPATE_FIELD(total_facets), any);
    visit(PALPATE_FIELD(facets_hidden), any);
    visit(PALPATE_FIELD(rigid), flag);
    visit(PALPATE_FIELD(first_vertex), any);
    visit(PALPATE_FIELD(n_vertices), count(max_surface_vertices));
    visit(PALPATE_FIELD(first_facet), any);
    visit(PALPATE_FIELD(n_facets), count(max_surface_facets));
    visit.first(PALPATE_FIELD(position), PALPATE_FIELD(n_vertices), within(farthest_vertex));
    visit.first(PALPATE_FIELD(corners), PALPATE_FIELD(n_facets), any);
    visit.first(PALPATE_FIELD(rgba), PALPATE_FIELD(n_facets), any);
    visit.rule("chunk", RejectReason::count, [](const auto& m) { return m.chunk < m.n_chunks; });
    visit.rule("total_vertices", RejectReason::count,
               [](const auto& m) { return fits(m.total_vertices, m.n_chunks, max_surface_vertices); });
    visit.rule("total_facets", RejectReason::count,
               [](const auto& m) { return fits(m.total_facets, m.n_chunks, max_surface_facets); });
    visit.rule("first_vertex", RejectReason::out_of_range,
               [](const auto& m) { return ends_by(m.first_vertex, m.n_vertices, m.total_vertices); });
    visit.rule("first_facet", RejectReason::out_of_range,
               [](const auto& m) { return ends_by(m.first_facet, m.n_facets, m.total_facets); });
    visit.rule("corners", RejectReason::unknown_id, [](const auto& m) {
      return all_of_first(m.corners, m.n_facets,
                          [&](const auto& facet) { return all_below(facet, m.total_vertices); });
    });
  }
  friend bool operator==(const BodySurface&, const BodySurface&) = default;
};

/// physics -> render. What breaks, cuts and new thresholds have changed in a BodySurface, as a list that only grows: a page is
/// written again until it is full, a full one never. Pages from 0 on therefore change the surface to what it is, for a reader
/// that has seen all as for one that comes late, and in whatever order they arrive. The list is complete up to some change when all
/// pages up to `total_changes` and `total_vertices` of its page are there. New vertices come behind all others and keep their numbers.
struct FacetChange {
  std::uint32_t facet = 0;                 // one that is there, or the next one behind the last
  std::array<std::uint32_t, 4> corners{};  // as in BodySurface
  std::uint32_t rgba = 0;

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(facet), below(max_surface_chunks * max_surface_facets));
    visit(PALPATE_FIELD(corners), any);
    visit(PALPATE_FIELD(rgba), any);
  }
  friend bool operator==(const FacetChange&, const FacetChange&) = default;
};
struct SurfaceChange {
  std::uint32_t body = 0;
  std::uint32_t revision = 0;  // of the BodySurface that is changed
  std::uint32_t page =
      0;  // < max_change_pages; a page begins where the one before it was full of vertices or facets
  std::uint32_t change = 0;  // grows with every new surface of this revision; starts at 1
  // All after this change.
  std::uint32_t total_vertices = 0;
  std::uint32_t total_facets = 0;   // what is behind them is gone
  std::uint32_t total_changes = 0;  // of facets, in all pages
  std::uint32_t facets_hidden = 0;
  // What is in this page.
  std::uint32_t first_vertex = 0;
  std::uint32_t n_vertices = 0;                         // <= max_change_vertices
  std::uint32_t first_change = 0;                       // of facets, counted through all pages
  std::uint32_t n_changes = 0;                          // <= max_change_facets
  std::array<Array3f, max_change_vertices> position{};  // at rest [m]
  std::array<FacetChange, max_change_facets> facets{};  // one after the other

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(body), below(max_bodies));
    visit(PALPATE_FIELD(revision), from_one);
    visit(PALPATE_FIELD(page), count(max_change_pages - 1));
    visit(PALPATE_FIELD(change), from_one);
    visit(PALPATE_FIELD(total_vertices), count(max_surface_chunks * max_surface_vertices));
    visit(PALPATE_FIELD(total_facets), count(max_surface_chunks * max_surface_facets));
    visit(PALPATE_FIELD(total_changes), count(max_change_pages * max_change_facets));
    visit(PALPATE_FIELD(facets_hidden), any);
    visit(PALPATE_FIELD(first_vertex), any);
    visit(PALPATE_FIELD(n_vertices), count(max_change_vertices));
    visit(PALPATE_FIELD(first_change), any);
    visit(PALPATE_FIELD(n_changes), count(max_change_facets));
    visit.first(PALPATE_FIELD(position), PALPATE_FIELD(n_vertices), within(farthest_vertex));
    visit.each(PALPATE_FIELD(facets), PALPATE_FIELD(n_changes), of_type<FacetChange>);
    visit.rule("first_vertex", RejectReason::out_of_range,
               [](const auto& m) { return ends_by(m.first_vertex, m.n_vertices, m.total_vertices); });
    visit.rule("first_change", RejectReason::out_of_range,
               [](const auto& m) { return ends_by(m.first_change, m.n_changes, m.total_changes); });
    visit.rule("facets.corners", RejectReason::unknown_id, [](const auto& m) {
      return all_of_first(m.facets, m.n_changes,
                          [&](const auto& facet) { return all_below(facet.corners, m.total_vertices); });
    });
  }
  friend bool operator==(const SurfaceChange&, const SurfaceChange&) = default;
};

/// State of a vertex.
inline constexpr std::uint8_t vertex_yielded = 1;  // an element at this vertex has yielded
inline constexpr std::uint8_t vertex_broken = 2;   // an element at this vertex has broken
inline constexpr std::uint8_t vertex_share_one =
    4;  // the other six bits: how many 63rds of its live elements have yielded,
        // which is how dark it is drawn; 0 unless vertex_yielded

/// physics -> render. Where some vertices of a BodySurface revision and of its changes are now. Only blocks that changed are sent.
struct VertexBlock {
  std::uint32_t body = 0;
  std::uint32_t revision = 0;  // of the BodySurface that numbers these vertices
  std::uint32_t block = 0;     // first_vertex / max_block_vertices
  std::uint64_t tick = 0;
  double t = 0;  // simulated time [s]
  std::uint32_t first_vertex = 0;
  std::uint32_t n_vertices = 0;                        // <= max_block_vertices
  std::array<Array3f, max_block_vertices> position{};  // [m]
  std::array<std::uint8_t, max_block_vertices> flags{};
  float field_most =
      0;  // of what colours show, where physics computes it (ColourKind): strain, [Pa], or 1; 0: nothing
  std::array<std::uint8_t, max_block_vertices> field{};  // 255ths of that

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(body), below(max_bodies));
    visit(PALPATE_FIELD(revision), from_one);
    visit(PALPATE_FIELD(block), any);
    visit(PALPATE_FIELD(tick), any);
    visit(PALPATE_FIELD(t), up_to(longest_time));
    visit(PALPATE_FIELD(first_vertex), any);
    visit(PALPATE_FIELD(n_vertices), count(max_block_vertices));
    visit.first(PALPATE_FIELD(position), PALPATE_FIELD(n_vertices), within(farthest_vertex));
    visit.first(PALPATE_FIELD(flags), PALPATE_FIELD(n_vertices), any);
    visit(PALPATE_FIELD(field_most), up_to(largest_field));
    visit.first(PALPATE_FIELD(field), PALPATE_FIELD(n_vertices), any);
    visit.rule("block", RejectReason::out_of_range,
               [](const auto& m) { return m.block == m.first_vertex / max_block_vertices; });
    visit.rule("first_vertex", RejectReason::out_of_range, [](const auto& m) {
      return fits(std::uint64_t{m.first_vertex} + m.n_vertices, max_surface_chunks, max_surface_vertices);
    });
    visit.rule("flags", RejectReason::out_of_range, [](const auto& m) {
      return all_of_first(m.flags, m.n_vertices, [](std::uint8_t flags) {
        return flags < vertex_share_one || (flags & vertex_yielded) != 0;
      });
    });
  }
  friend bool operator==(const VertexBlock&, const VertexBlock&) = default;
};

}  // namespace palpate
