#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

namespace {

constexpr std::uint32_t most_vertices = max_surface_chunks * max_surface_vertices;
constexpr std::uint32_t most_facets = max_surface_chunks * max_surface_facets;

bool corners_exist(const palpate_wire_SurfaceChange& wire) noexcept {
  return std::all_of(wire.facets, wire.facets + wire.n_changes, [&](const palpate_wire_FacetChange& facet) {
    return std::all_of(facet.corners, facet.corners + 4,
                       [&](std::uint32_t corner) { return corner < wire.total_vertices; });
  });
}

bool facets_exist(const palpate_wire_SurfaceChange& wire) noexcept {
  return std::all_of(wire.facets, wire.facets + wire.n_changes,
                     [](const palpate_wire_FacetChange& facet) { return facet.facet < most_facets; });
}

}  // namespace

Verdict judge(const palpate_wire_SurfaceChange& wire) noexcept {
  Check check(wire.version);
  check.that(wire.body < max_bodies, RejectReason::unknown_id, "body")
      .that(wire.n_vertices <= max_change_vertices, RejectReason::count, "n_vertices")
      .that(wire.n_changes <= max_change_facets, RejectReason::count, "n_changes")
      .that(wire.page < max_change_pages, RejectReason::count, "page")
      .that(wire.total_vertices <= most_vertices, RejectReason::count, "total_vertices")
      .that(wire.total_facets <= most_facets, RejectReason::count, "total_facets")
      .that(wire.total_changes <= max_change_pages * max_change_facets, RejectReason::count, "total_changes")
      .that(ends_by(wire.first_vertex, wire.n_vertices, wire.total_vertices), RejectReason::out_of_range,
            "first_vertex")
      .that(ends_by(wire.first_change, wire.n_changes, wire.total_changes), RejectReason::out_of_range,
            "first_change")
      .that(wire.revision > 0, RejectReason::out_of_range, "revision")
      .that(wire.change > 0, RejectReason::out_of_range, "change")
      .bounded(wire.position, farthest_vertex, "position", wire.n_vertices);
  if (check.verdict()) return check.verdict();
  return check.that(facets_exist(wire), RejectReason::unknown_id, "facet")
      .that(corners_exist(wire), RejectReason::unknown_id, "corners")
      .verdict();
}

Verdict from_wire(const palpate_wire_SurfaceChange& wire, SurfaceChange& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.body = wire.body;
  message.revision = wire.revision;
  message.page = wire.page;
  message.change = wire.change;
  message.total_vertices = wire.total_vertices;
  message.total_facets = wire.total_facets;
  message.total_changes = wire.total_changes;
  message.facets_hidden = wire.facets_hidden;
  message.first_vertex = wire.first_vertex;
  message.n_vertices = wire.n_vertices;
  message.first_change = wire.first_change;
  message.n_changes = wire.n_changes;
  copy(wire.position, message.position, wire.n_vertices);
  for (std::uint32_t n = 0; n < wire.n_changes; ++n) {
    message.facets[n].facet = wire.facets[n].facet;
    copy(wire.facets[n].corners, message.facets[n].corners);
    message.facets[n].rgba = wire.facets[n].rgba;
  }
  return {};
}

void to_wire(const SurfaceChange& message, palpate_wire_SurfaceChange& wire) noexcept {
  wire.version = wire_version;
  wire.body = message.body;
  wire.revision = message.revision;
  wire.page = message.page;
  wire.change = message.change;
  wire.total_vertices = message.total_vertices;
  wire.total_facets = message.total_facets;
  wire.total_changes = message.total_changes;
  wire.facets_hidden = message.facets_hidden;
  wire.first_vertex = message.first_vertex;
  wire.n_vertices = message.n_vertices;
  wire.first_change = message.first_change;
  wire.n_changes = message.n_changes;
  copy(message.position, wire.position, message.n_vertices);
  for (std::uint32_t n = 0; n < message.n_changes; ++n) {
    wire.facets[n].facet = message.facets[n].facet;
    copy(message.facets[n].corners, wire.facets[n].corners);
    wire.facets[n].rgba = message.facets[n].rgba;
  }
}

}  // namespace palpate
