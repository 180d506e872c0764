#pragma once
// One body on the graphics card. Only what changed is uploaded.

#include <cstddef>

#include "render_node/gl/buffer.h"
#include "render_node/gl/lit_program.h"
#include "render_node/model/body_picture.h"

namespace palpate::render {

class TissueDrawing {
 public:
  TissueDrawing();

  /// Uploads what is dirty and clears the dirt. @return bytes uploaded
  std::size_t upload(BodyPicture& body);

  /// Closed: only its outside shows, so the far side need not be drawn.
  bool closed() const noexcept { return closed_; }
  /// Facets so small that lighting at the vertices is as good.
  bool dense() const noexcept { return n_triangle_indices_ > 120000; }

  void draw(const LitProgram& program) const;
  /// The edges of the facets, over the surface. Their index buffer is made when first asked for.
  void draw_wire(const LitProgram& program, const BodyPicture& body);

 private:
  std::size_t upload_all(const BodyPicture& body);
  VertexArray array_;
  Buffer position_{Buffer::Kind::vertices};
  Buffer packed_{Buffer::Kind::vertices};
  Buffer colour_{Buffer::Kind::vertices};
  Buffer triangles_{Buffer::Kind::indices};
  Buffer edges_{Buffer::Kind::indices};
  bool closed_ = false;
  std::size_t n_triangle_indices_ = 0;
  std::size_t n_edge_indices_ = 0;  // 0: not made yet for this revision
};

}  // namespace palpate::render
