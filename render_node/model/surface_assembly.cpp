#include "render_node/model/surface_assembly.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error/error.h"

namespace palpate::render {
namespace {

bool inside(std::uint32_t first, std::uint32_t n, std::uint32_t total) {
  return n <= total && first <= total - n;
}

}  // namespace

bool SurfaceAssembly::well_formed(const BodySurface& chunk) noexcept {
  const std::uint64_t most = chunk.n_chunks;
  if (chunk.revision == 0 || chunk.n_chunks == 0 || chunk.n_chunks > max_surface_chunks) return false;
  if (chunk.chunk >= chunk.n_chunks) return false;
  if (chunk.n_vertices > max_surface_vertices || chunk.n_facets > max_surface_facets) return false;
  if (chunk.total_vertices > most * max_surface_vertices || chunk.total_facets > most * max_surface_facets) {
    return false;
  }
  if (!inside(chunk.first_vertex, chunk.n_vertices, chunk.total_vertices)) return false;
  if (!inside(chunk.first_facet, chunk.n_facets, chunk.total_facets)) return false;
  const auto corner_exists = [&](std::uint32_t corner) { return corner < chunk.total_vertices; };
  for (std::uint32_t f = 0; f < chunk.n_facets; ++f) {
    if (!std::all_of(chunk.corners[f].begin(), chunk.corners[f].end(), corner_exists)) return false;
  }
  const auto finite = [](float value) { return std::isfinite(value); };
  for (std::uint32_t v = 0; v < chunk.n_vertices; ++v) {
    if (!std::all_of(chunk.position[v].begin(), chunk.position[v].end(), finite)) return false;
  }
  return true;
}

bool SurfaceAssembly::belongs(const BodySurface& chunk) const noexcept {
  return chunk.n_chunks == pending_->n_chunks && chunk.total_vertices == pending_->n_vertices &&
         chunk.total_facets == pending_->n_facets;
}

ChunkFate SurfaceAssembly::take(const BodySurface& chunk) {
  if (!well_formed(chunk)) return ChunkFate::malformed;
  if (chunk.revision <= shown_revision_ || chunk.revision < pending_revision()) return ChunkFate::stale;
  if (chunk.revision > pending_revision()) start(chunk);
  if (!belongs(chunk)) return ChunkFate::malformed;
  if (!keep(chunk)) return ChunkFate::too_large;
  if (pending_->parts.size() < pending_->n_chunks) return ChunkFate::kept;
  if (join()) return ChunkFate::completed;
  pending_.reset();
  return ChunkFate::malformed;
}

void SurfaceAssembly::start(const BodySurface& chunk) {
  pending_.reset();
  pending_.emplace(
      Pending{{}, chunk.n_chunks, chunk.total_vertices, chunk.total_facets, {}, MemoryHold(budget_)});
  Surface& surface = pending_->surface;
  surface.body = chunk.body;
  surface.revision = chunk.revision;
  surface.rigid = chunk.rigid != 0;
  surface.facets_hidden = chunk.facets_hidden;
}

/// @return false if there is no room for it
bool SurfaceAssembly::keep(const BodySurface& chunk) {
  const auto before = pending_->parts.find(chunk.chunk);
  if (before == pending_->parts.end() &&
      !pending_->memory.add(sizeof(Part) + chunk.n_vertices * sizeof(Array3f) +
                            chunk.n_facets * (sizeof(Corners) + sizeof(std::uint32_t))))
    return false;
  if (before != pending_->parts.end()) return true;  // it comes twice
  Part& part = pending_->parts[chunk.chunk];
  part.first_vertex = chunk.first_vertex;
  part.first_facet = chunk.first_facet;
  part.position.assign(chunk.position.begin(), chunk.position.begin() + chunk.n_vertices);
  part.corners.assign(chunk.corners.begin(), chunk.corners.begin() + chunk.n_facets);
  part.rgba.assign(chunk.rgba.begin(), chunk.rgba.begin() + chunk.n_facets);
  return true;
}

/// @return false if the parts leave gaps or lie over one another
bool SurfaceAssembly::join() {
  std::size_t vertices = 0, facets = 0;
  for (const auto& [number, part] : pending_->parts) {
    if (part.first_vertex != vertices || part.first_facet != facets) return false;
    vertices += part.position.size();
    facets += part.corners.size();
  }
  if (vertices != pending_->n_vertices || facets != pending_->n_facets) return false;
  Surface& surface = pending_->surface;
  surface.position.reserve(vertices);
  surface.corners.reserve(facets);
  surface.rgba.reserve(facets);
  for (const auto& [number, part] : pending_->parts) {
    surface.position.insert(surface.position.end(), part.position.begin(), part.position.end());
    surface.corners.insert(surface.corners.end(), part.corners.begin(), part.corners.end());
    surface.rgba.insert(surface.rgba.end(), part.rgba.begin(), part.rgba.end());
  }
  return true;
}

Surface SurfaceAssembly::finished() {
  PALPATE_CHECK(pending_ && pending_->parts.size() == pending_->n_chunks,
                "finished() before all chunks came");
  Surface surface = std::move(pending_->surface);
  pending_.reset();
  shown_revision_ = surface.revision;
  return surface;
}

}  // namespace palpate::render
