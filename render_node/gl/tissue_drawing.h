#pragma once
// One body on the graphics card. Only what changed is uploaded.

#include <cstddef>
#include <optional>
#include <vector>

#include "render_node/gl/buffer.h"
#include "render_node/gl/lit_program.h"
#include "render_node/model/body_picture.h"
#include "render_node/model/surface_chunks.h"
#include "render_node/view/pixel_box.h"

namespace palpate::render {

class TissueDrawing {
 public:
  TissueDrawing();

  /// Uploads what is dirty and clears the dirt. @return bytes uploaded
  std::size_t upload(BodyPicture& body);
  /// Which pixels the last upload() may have changed; nothing: any. Call it before look_at().
  /// @param opened  by a section: its inside shows  @param wired  the edges of facets are drawn, too
  std::optional<PixelBoxes> changed_pixels(const Lens& lens, bool opened, bool wired);
  /// Only facets that may appear there are drawn from now on, as changed_pixels() saw them.
  void look_at(const PixelBox& area);

  /// Closed: only its outside shows, so the far side need not be drawn.
  bool closed() const noexcept { return closed_; }
  /// Facets so small that lighting at the vertices is as good.
  bool dense() const noexcept { return chunks_.indices().size() > 120000; }
  float longest_edge() const noexcept { return chunks_.longest_edge(); }  // of a facet [m]

  /// @param opacity  below 1 blending has to be on
  void draw(const LitProgram& program, float opacity = 1) const;
  /// Elements that no facet shows, and the edges of the facets if asked for: their index buffer is made the first time.
  void draw_lines(const LitProgram& program, const BodyPicture& body, bool with_edges);
  /// Masses that no facet and no element shows, as points.
  void draw_beads(const LitProgram& program) const;
  bool has_beads() const noexcept { return n_bead_indices_ > 0; }
  bool has_lines() const noexcept { return n_line_indices_ > 0; }

 private:
  std::size_t upload_all(const BodyPicture& body);
  VertexArray array_;
  Buffer position_{Buffer::Kind::vertices};
  Buffer packed_{Buffer::Kind::vertices};
  Buffer colour_{Buffer::Kind::vertices};
  Buffer rest_{Buffer::Kind::vertices};
  Buffer field_{Buffer::Kind::vertices};
  Buffer triangles_{Buffer::Kind::indices};
  Buffer edges_{Buffer::Kind::indices};
  Buffer lines_{Buffer::Kind::indices};
  Buffer beads_{Buffer::Kind::indices};
  bool closed_ = false;
  SurfaceChunks chunks_;
  PixelBox pixels_of_chunk(std::size_t chunk) const;
  // As changed_pixels() was last asked, where each chunk appears; those that show their back alone do not.
  Lens lens_;
  bool one_sided_ = false;
  std::vector<PixelBox> appears_;                   // (n_chunks)
  bool all_changed_ = false, any_changed_ = false;  // by the last upload()
  std::vector<int> seen_counts_;                    // of indices, of each run of chunks that is looked at
  std::vector<const void*> seen_offsets_;           // [bytes]
  std::size_t n_edge_indices_ = 0;                  // 0: not made yet for this revision
  std::size_t n_line_indices_ = 0;
  std::size_t n_bead_indices_ = 0;
};

}  // namespace palpate::render
