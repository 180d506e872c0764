#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

namespace {

bool corners_exist(const palpate_wire_BodySurface& wire) noexcept {
  return std::all_of(wire.corners, wire.corners + wire.n_facets, [&](const auto& facet) {
    return std::all_of(facet, facet + 4, [&](std::uint32_t corner) { return corner < wire.total_vertices; });
  });
}

}  // namespace

Verdict judge(const palpate_wire_BodySurface& wire) noexcept {
  const std::uint64_t chunks = wire.n_chunks;
  Check check(wire.version);
  check.that(wire.body < max_bodies, RejectReason::unknown_id, "body")
      .that(wire.n_vertices <= max_surface_vertices, RejectReason::count, "n_vertices")
      .that(wire.n_facets <= max_surface_facets, RejectReason::count, "n_facets")
      .that(chunks <= max_surface_chunks, RejectReason::count, "n_chunks")
      .that(wire.chunk < wire.n_chunks, RejectReason::count, "chunk")
      .that(wire.total_vertices <= chunks * max_surface_vertices, RejectReason::count, "total_vertices")
      .that(wire.total_facets <= chunks * max_surface_facets, RejectReason::count, "total_facets")
      .that(ends_by(wire.first_vertex, wire.n_vertices, wire.total_vertices), RejectReason::out_of_range,
            "first_vertex")
      .that(ends_by(wire.first_facet, wire.n_facets, wire.total_facets), RejectReason::out_of_range,
            "first_facet")
      .that(wire.revision > 0, RejectReason::out_of_range, "revision")
      .that(wire.rigid <= 1, RejectReason::out_of_range, "rigid")
      .bounded(wire.position, farthest_vertex, "position", wire.n_vertices);
  if (check.verdict()) return check.verdict();
  return check.that(corners_exist(wire), RejectReason::unknown_id, "corners").verdict();
}

Verdict from_wire(const palpate_wire_BodySurface& wire, BodySurface& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.body = wire.body;
  message.revision = wire.revision;
  message.chunk = wire.chunk;
  message.n_chunks = wire.n_chunks;
  message.total_vertices = wire.total_vertices;
  message.total_facets = wire.total_facets;
  message.facets_hidden = wire.facets_hidden;
  message.rigid = wire.rigid;
  message.first_vertex = wire.first_vertex;
  message.n_vertices = wire.n_vertices;
  message.first_facet = wire.first_facet;
  message.n_facets = wire.n_facets;
  copy(wire.position, message.position, wire.n_vertices);
  copy(wire.corners, message.corners, wire.n_facets);
  copy(wire.rgba, message.rgba, wire.n_facets);
  return {};
}

void to_wire(const BodySurface& message, palpate_wire_BodySurface& wire) noexcept {
  wire.version = wire_version;
  wire.body = message.body;
  wire.revision = message.revision;
  wire.chunk = message.chunk;
  wire.n_chunks = message.n_chunks;
  wire.total_vertices = message.total_vertices;
  wire.total_facets = message.total_facets;
  wire.facets_hidden = message.facets_hidden;
  wire.rigid = message.rigid;
  wire.first_vertex = message.first_vertex;
  wire.n_vertices = message.n_vertices;
  wire.first_facet = message.first_facet;
  wire.n_facets = message.n_facets;
  copy(message.position, wire.position, message.n_vertices);
  copy(message.corners, wire.corners, message.n_facets);
  copy(message.rgba, wire.rgba, message.n_facets);
}

Verdict judge(const palpate_wire_VertexBlock& wire) noexcept {
  constexpr std::uint64_t most = std::uint64_t{max_surface_chunks} * max_surface_vertices;
  Check check(wire.version);
  check.that(wire.body < max_bodies, RejectReason::unknown_id, "body")
      .that(wire.n_vertices <= max_block_vertices, RejectReason::count, "n_vertices")
      .that(wire.block == wire.first_vertex / max_block_vertices, RejectReason::out_of_range, "block")
      .that(ends_by(wire.first_vertex, wire.n_vertices, most), RejectReason::out_of_range, "first_vertex")
      .that(wire.revision > 0, RejectReason::out_of_range, "revision")
      .positive(wire.t, longest_time, "t")
      .bounded(wire.position, farthest_vertex, "position", wire.n_vertices);
  if (check.verdict()) return check.verdict();
  const bool sound = std::all_of(wire.flags, wire.flags + wire.n_vertices, [](std::uint8_t flags) {
    return flags < vertex_share_one || (flags & vertex_yielded) != 0;
  });
  return check.that(sound, RejectReason::out_of_range, "flags").verdict();
}

Verdict from_wire(const palpate_wire_VertexBlock& wire, VertexBlock& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.body = wire.body;
  message.revision = wire.revision;
  message.block = wire.block;
  message.tick = wire.tick;
  message.t = wire.t;
  message.first_vertex = wire.first_vertex;
  message.n_vertices = wire.n_vertices;
  copy(wire.position, message.position, wire.n_vertices);
  copy(wire.flags, message.flags, wire.n_vertices);
  return {};
}

void to_wire(const VertexBlock& message, palpate_wire_VertexBlock& wire) noexcept {
  wire.version = wire_version;
  wire.body = message.body;
  wire.revision = message.revision;
  wire.block = message.block;
  wire.tick = message.tick;
  wire.t = message.t;
  wire.first_vertex = message.first_vertex;
  wire.n_vertices = message.n_vertices;
  copy(message.position, wire.position, message.n_vertices);
  copy(message.flags, wire.flags, message.n_vertices);
}

}  // namespace palpate
