#include "render_node/gl/tissue_drawing.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <vector>

#include "render_node/model/closedness.h"

namespace palpate::render {
namespace {

const void* offset_of(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

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
  for (const auto place : {at_position, at_normal, at_flags, at_colour}) glEnableVertexAttribArray(place);
}

std::size_t TissueDrawing::upload(BodyPicture& body) {
  std::size_t bytes = 0;
  if (body.all_dirty()) {
    bytes = upload_all(body);
  } else {
    const std::span<const Array3f> position = body.surface().position;
    const std::span<const PackedVertex> packed = body.packed();
    for (const auto& range : body.dirty_ranges()) {
      position_.update(range.first, position.subspan(range.first, range.n));
      packed_.update(range.first, packed.subspan(range.first, range.n));
      bytes += range.n * (sizeof(Array3f) + sizeof(PackedVertex));
    }
  }
  body.clear_dirty();
  return bytes;
}

std::size_t TissueDrawing::upload_all(const BodyPicture& body) {
  std::vector<std::uint32_t> indices;
  indices.reserve(6 * body.surface().corners.size());
  for (const auto& c : body.surface().corners) {
    indices.insert(indices.end(), {c[0], c[1], c[2]});
    if (c[2] != c[3]) indices.insert(indices.end(), {c[0], c[2], c[3]});
  }
  array_.bind();
  position_.upload(std::span<const Array3f>(body.surface().position));
  packed_.upload(std::span<const PackedVertex>(body.packed()));
  colour_.upload(std::span<const std::uint32_t>(body.vertex_rgba()));
  triangles_.upload(std::span<const std::uint32_t>(indices));
  n_triangle_indices_ = indices.size();
  n_edge_indices_ = 0;
  closed_ = is_closed(body.surface());
  return indices.size() * sizeof(std::uint32_t) +
         body.packed().size() * (sizeof(Array3f) + sizeof(PackedVertex) + sizeof(std::uint32_t));
}

void TissueDrawing::draw(const LitProgram& program) const {
  program.place(Eigen::Matrix4f::Identity());
  program.finish(0.035F, 1.0F);
  array_.bind();
  triangles_.bind();
  if (closed_) glEnable(GL_CULL_FACE);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(n_triangle_indices_), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CULL_FACE);
}

void TissueDrawing::draw_wire(const LitProgram& program, const BodyPicture& body) {
  array_.bind();
  if (n_edge_indices_ == 0) {
    std::vector<std::uint32_t> indices;
    indices.reserve(8 * body.surface().corners.size());
    for (const auto& c : body.surface().corners) {
      indices.insert(indices.end(), {c[0], c[1], c[1], c[2], c[2], c[3], c[3], c[0]});
    }
    edges_.upload(std::span<const std::uint32_t>(indices));
    n_edge_indices_ = indices.size();
  }
  program.place(Eigen::Matrix4f::Identity());
  program.finish(0.0F, 1.0F);
  program.darken(0.8F);
  edges_.bind();
  glDrawElements(GL_LINES, static_cast<GLsizei>(n_edge_indices_), GL_UNSIGNED_INT, nullptr);
  program.darken(0.0F);
}

}  // namespace palpate::render
