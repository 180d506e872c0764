#include "render_node/model/surface_assembly.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error/error.h"

namespace palpate::render {
namespace {

constexpr std::uint32_t max_chunks = 1u << 15;  // 67 million vertices: more is a mistake, not a picture

bool inside(std::uint32_t first, std::uint32_t n, std::uint32_t total) {
  return n <= total && first <= total - n;
}

}  // namespace

bool SurfaceAssembly::well_formed(const BodySurface& chunk) noexcept {
  const std::uint64_t most = chunk.n_chunks;
  if (chunk.revision == 0 || chunk.n_chunks == 0 || chunk.n_chunks > max_chunks) return false;
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
  const Surface& surface = pending_->surface;
  return chunk.n_chunks == pending_->has.size() && chunk.total_vertices == surface.position.size() &&
         chunk.total_facets == surface.corners.size();
}

ChunkFate SurfaceAssembly::take(const BodySurface& chunk) {
  if (!well_formed(chunk)) return ChunkFate::malformed;
  if (chunk.revision <= shown_revision_ || chunk.revision < pending_revision()) return ChunkFate::stale;
  if (chunk.revision > pending_revision()) start(chunk);
  if (!belongs(chunk)) return ChunkFate::malformed;
  copy(chunk);
  return pending_->missing == 0 ? ChunkFate::completed : ChunkFate::kept;
}

void SurfaceAssembly::start(const BodySurface& chunk) {
  Surface surface;
  surface.body = chunk.body;
  surface.revision = chunk.revision;
  surface.rigid = chunk.rigid != 0;
  surface.facets_hidden = chunk.facets_hidden;
  surface.position.resize(chunk.total_vertices);
  surface.corners.resize(chunk.total_facets);
  surface.rgba.resize(chunk.total_facets);
  pending_ = Pending{std::move(surface), std::vector<bool>(chunk.n_chunks, false), chunk.n_chunks};
}

void SurfaceAssembly::copy(const BodySurface& chunk) {
  Surface& surface = pending_->surface;
  std::copy_n(chunk.position.begin(), chunk.n_vertices, surface.position.begin() + chunk.first_vertex);
  std::copy_n(chunk.corners.begin(), chunk.n_facets, surface.corners.begin() + chunk.first_facet);
  std::copy_n(chunk.rgba.begin(), chunk.n_facets, surface.rgba.begin() + chunk.first_facet);
  if (pending_->has[chunk.chunk]) return;
  pending_->has[chunk.chunk] = true;
  --pending_->missing;
}

Surface SurfaceAssembly::finished() {
  PALPATE_CHECK(pending_ && pending_->missing == 0, "finished() before all chunks came");
  Surface surface = std::move(pending_->surface);
  pending_.reset();
  shown_revision_ = surface.revision;
  return surface;
}

}  // namespace palpate::render
