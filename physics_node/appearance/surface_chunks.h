#pragma once
// A whole surface, chunk by chunk.

#include <algorithm>
#include <array>
#include <functional>
#include <span>

#include "common/message/messages.h"

namespace palpate::physics {

inline std::uint32_t n_chunks(std::size_t vertices, std::size_t facets) {
  const auto chunks_for = [](std::size_t n, std::size_t per_chunk) {
    return static_cast<std::uint32_t>((n + per_chunk - 1) / per_chunk);
  };
  return std::max({1U, chunks_for(vertices, max_surface_vertices), chunks_for(facets, max_surface_facets)});
}

/// @param out  room for a chunk, in which body, revision, facets_hidden and rigid are filled in
/// @param position  of a vertex by its number, as Array3f
template <class Position>
void write_chunks(BodySurface& out, std::size_t n_vertices,
                  std::span<const std::array<std::uint32_t, 4>> facets, std::span<const std::uint32_t> rgba,
                  const Position& position, const std::function<void(const BodySurface&)>& sink) {
  out.total_vertices = static_cast<std::uint32_t>(n_vertices);
  out.total_facets = static_cast<std::uint32_t>(facets.size());
  out.n_chunks = n_chunks(n_vertices, facets.size());
  for (out.chunk = 0; out.chunk < out.n_chunks; ++out.chunk) {
    out.first_vertex = std::min(out.chunk * max_surface_vertices, out.total_vertices);
    out.n_vertices = std::min(max_surface_vertices, out.total_vertices - out.first_vertex);
    out.first_facet = std::min(out.chunk * max_surface_facets, out.total_facets);
    out.n_facets = std::min(max_surface_facets, out.total_facets - out.first_facet);
    for (std::uint32_t n = 0; n < out.n_vertices; ++n) out.position[n] = position(out.first_vertex + n);
    std::copy_n(facets.begin() + out.first_facet, out.n_facets, out.corners.begin());
    std::copy_n(rgba.begin() + out.first_facet, out.n_facets, out.rgba.begin());
    sink(out);
  }
}

}  // namespace palpate::physics
