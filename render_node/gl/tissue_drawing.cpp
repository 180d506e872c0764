#include "render_node/gl/tissue_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "render_node/model/closedness.h"

namespace palpate::render {
namespace {

const void* offset_of(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

using Indices = std::vector<std::uint32_t>;

/// Both ends of every edge of the facets, each edge once.
Indices edges_of(const std::vector<Corners>& facets) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(4 * facets.size());
  for (const auto& c : facets) {
    if (is_loose(c)) continue;
    for (std::size_t i = 0; i < 4; ++i)
      if (c[i] != c[(i + 1) % 4]) edges.emplace_back(std::minmax(c[i], c[(i + 1) % 4]));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  Indices indices;
  indices.reserve(2 * edges.size());
  for (const auto& [a, b] : edges) indices.insert(indices.end(), {a, b});
  return indices;
}

}  // namespace

TissueDrawing::TissueDrawing() {
  array_.bind();
  position_.bind();
  glVertexAttribPointer(at_position, 3, GL_FLOAT, GL_FALSE, sizeof(Array3f), nullptr);
  packed_.bind();
  glVertexAttribPointer(at_normal, 3, GL_SHORT, GL_TRUE, sizeof(PackedVertex), nullptr);
  glVertexAttribIPointer(at_flags, 1, GL_UNSIGNED_SHORT, sizeof(PackedVertex),
                         offset_of(offsetof(PackedVertex, flags)));
  colour_.bind();
  glVertexAttribPointer(at_colour, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(std::uint32_t), nullptr);
  rest_.bind();
  glVertexAttribPointer(at_rest, 3, GL_FLOAT, GL_FALSE, sizeof(Array3f), nullptr);
  field_.bind();
  glVertexAttribPointer(at_field, 1, GL_FLOAT, GL_FALSE, sizeof(float), nullptr);
  for (const auto place : {at_position, at_normal, at_flags, at_colour, at_rest, at_field})
    glEnableVertexAttribArray(place);
}

std::size_t TissueDrawing::upload(BodyPicture& body) {
  std::size_t bytes = 0;
  all_changed_ = body.all_dirty();
  any_changed_ = all_changed_ || !body.dirty_vertices().empty();
  if (all_changed_) {
    bytes = upload_all(body);
  } else {
    chunks_.follow(body.surface(), body.dirty_vertices());
    const std::span<const Array3f> position = body.surface().position;
    const std::span<const PackedVertex> packed = body.packed();
    for (const auto& range : body.dirty_ranges()) {
      position_.update(range.first, position.subspan(range.first, range.n));
      packed_.update(range.first, packed.subspan(range.first, range.n));
      field_.update(range.first, std::span<const float>(body.field()).subspan(range.first, range.n));
      bytes += range.n * (sizeof(Array3f) + sizeof(PackedVertex) + sizeof(float));
    }
  }
  body.clear_dirty();
  return bytes;
}

std::size_t TissueDrawing::upload_all(const BodyPicture& body) {
  Indices lines, beads;
  for (const auto& c : body.surface().corners) {
    if (is_mass(c))
      beads.push_back(c[0]);
    else if (is_loose(c))
      lines.insert(lines.end(), {c[0], c[1]});
  }
  chunks_.build(body.surface());
  array_.bind();
  position_.upload(std::span<const Array3f>(body.surface().position));
  packed_.upload(std::span<const PackedVertex>(body.packed()));
  colour_.upload(std::span<const std::uint32_t>(body.vertex_rgba()));
  rest_.upload(std::span<const Array3f>(body.rest()));
  field_.upload(std::span<const float>(body.field()));
  triangles_.upload(chunks_.indices());
  lines_.upload(std::span<const std::uint32_t>(lines));
  beads_.upload(std::span<const std::uint32_t>(beads));
  n_line_indices_ = lines.size();
  n_bead_indices_ = beads.size();
  n_edge_indices_ = 0;
  closed_ = is_closed(body.surface());
  return (chunks_.indices().size() + lines.size() + beads.size()) * sizeof(std::uint32_t) +
         body.packed().size() *
             (2 * sizeof(Array3f) + sizeof(PackedVertex) + sizeof(std::uint32_t) + sizeof(float));
}

PixelBox TissueDrawing::pixels_of_chunk(std::size_t chunk) const {
  return one_sided_ && chunks_.faces_away(chunk, lens_.eye) ? PixelBox{}
                                                            : pixels_of(lens_, chunks_.boxes()[chunk]);
}

std::optional<PixelBoxes> TissueDrawing::changed_pixels(const Lens& lens, bool opened, bool wired) {
  PixelBoxes pixels;
  const bool one_sided = closed_ && !opened;
  if (all_changed_ || lens_ != lens || one_sided_ != one_sided) {
    lens_ = lens;
    one_sided_ = one_sided;
    appears_.clear();
    for (std::size_t chunk = 0; chunk < chunks_.runs().size(); ++chunk)
      appears_.push_back(pixels_of_chunk(chunk));
    return std::nullopt;
  }
  for (const std::uint32_t chunk : chunks_.changed()) {
    PixelBox& seen = appears_[chunk];
    PixelBox both = seen;
    seen = pixels_of_chunk(chunk);
    both.extend(seen);
    pixels.add(both);
  }
  if (any_changed_ && (has_beads() || has_lines() || wired))
    return std::nullopt;  // no chunk knows where they are
  return pixels;
}

void TissueDrawing::look_at(const PixelBox& area) {
  seen_counts_.clear();
  seen_offsets_.clear();
  std::size_t end = 0;  // of the last run [indices]
  for (std::size_t chunk = 0; chunk < chunks_.runs().size(); ++chunk) {
    const auto& run = chunks_.runs()[chunk];
    if (!appears_[chunk].meets(area)) continue;
    if (seen_counts_.empty() || run.first != end) {
      seen_counts_.push_back(0);
      seen_offsets_.push_back(offset_of(run.first * sizeof(std::uint32_t)));
    }
    seen_counts_.back() += static_cast<int>(run.n);
    end = run.first + run.n;
  }
}

void TissueDrawing::draw(const LitProgram& program, float opacity) const {
  program.place(Eigen::Matrix4f::Identity());
  program.finish(0.035F, opacity);
  array_.bind();
  triangles_.bind();
  if (one_sided_) glEnable(GL_CULL_FACE);
  glMultiDrawElements(GL_TRIANGLES, seen_counts_.data(), GL_UNSIGNED_INT, seen_offsets_.data(),
                      static_cast<GLsizei>(seen_counts_.size()));
  glDisable(GL_CULL_FACE);
}

void TissueDrawing::draw_lines(const LitProgram& program, const BodyPicture& body, bool with_edges) {
  program.place(Eigen::Matrix4f::Identity());
  array_.bind();
  if (n_line_indices_ > 0) {
    lines_.bind();
    glDrawElements(GL_LINES, static_cast<GLsizei>(n_line_indices_), GL_UNSIGNED_INT, nullptr);
  }
  if (!with_edges) return;
  if (n_edge_indices_ == 0) {
    const Indices edges = edges_of(body.surface().corners);
    edges_.upload(std::span<const std::uint32_t>(edges));
    n_edge_indices_ = edges.size();
  }
  edges_.bind();
  glDrawElements(GL_LINES, static_cast<GLsizei>(n_edge_indices_), GL_UNSIGNED_INT, nullptr);
}

void TissueDrawing::draw_beads(const LitProgram& program) const {
  program.place(Eigen::Matrix4f::Identity());
  program.finish(0.10F, 1.0F);
  array_.bind();
  beads_.bind();
  glEnable(GL_PROGRAM_POINT_SIZE);
  glDrawElements(GL_POINTS, static_cast<GLsizei>(n_bead_indices_), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_PROGRAM_POINT_SIZE);
}

}  // namespace palpate::render
