#pragma once
// Draws the whole picture but for the panels, in this order: bodies, tools, arrows, gradient, floor, walls, and then tissue
// that is not opaque. It keeps what it drew: of the next picture only the rectangles in which anything changed are drawn, the same
// pixels as if all were.
// Needs a current OpenGL 3.3 context from construction to destruction.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/scene_fwd.h"
#include "render_node/gl/backdrop_drawing.h"
#include "render_node/gl/framebuffer.h"
#include "render_node/gl/lit_program.h"
#include "render_node/gl/tissue_drawing.h"
#include "render_node/gl/tool_drawing.h"
#include "render_node/model/view_model.h"
#include "render_node/view/camera.h"
#include "render_node/view/colour_scale.h"
#include "render_node/view/hidden.h"
#include "render_node/view/pixel_box.h"

namespace palpate::render {

/// What of the scene's [render] table a hand may switch while it runs.
struct PaintOptions {
  bool tool = true, force = true, wire = false, fragments = false;
  ColourKind colour = ColourKind::own;      // what colours of tissue say
  std::optional<SectionSpec> section = {};  // across which bodies are shown cut open
  bool inside = false;                      // of images is shown
  float opacity = 1;                        // of tissue
  Hidden hidden = {};
  friend bool operator==(const PaintOptions&, const PaintOptions&) = default;
};

class Painter {
 public:
  /// @param samples  a pixel; 0: no smoothing of edges
  Painter(const Scene& scene, const ViewModel& model, int samples);

  /// Into the framebuffer bound now, which has one sample a pixel. Uploads what changed.
  /// @param width,height  of the framebuffer [px]
  void draw(ViewModel& model, const Camera& camera, const PaintOptions& options, int width, int height);
  /// The next draw() draws all of it.
  void draw_whole() noexcept { seen_.reset(); }

  double arrow_metres_per_newton() const noexcept { return metres_per_newton_; }  // 0: nothing seen yet
  /// What its colours say, where they were asked for.
  const ColourScale& colour_scale() const noexcept { return colour_scale_; }
  // Of the last draw():
  std::size_t bytes_uploaded() const noexcept { return bytes_uploaded_; }
  const PixelBoxes& drawn() const noexcept { return drawn_; }  // the rest was as before

 private:
  /// Where any of it differs nothing may be kept.
  struct Seen {
    Lens lens;
    PaintOptions options;
    double size = 0, most = 0;
    friend bool operator==(const Seen&, const Seen&) = default;
  };
  void adapt_sizes(const Eigen::AlignedBox3d& box);
  void place_tools(const ViewModel& model, const PaintOptions& options);
  void follow_colours(const ViewModel& model, const PaintOptions& options);
  bool has_lines(const ViewModel& model, const PaintOptions& options) const;
  void upload(ViewModel& model, const PaintOptions& options);
  PixelBoxes changed_pixels(const ViewModel& model, const Lens& lens, const PaintOptions& options);
  void add_touched_pixels(const Lens& lens, const std::vector<Touch>& before, PixelBoxes& pixels) const;
  void draw_area(const ViewModel& model, const Camera& camera, const PaintOptions& options,
                 const PixelBox& area);
  bool is_tissue(std::size_t picture) const;
  bool is_shown(const ViewModel& model, std::size_t picture, const PaintOptions& options) const;
  bool is_opened(std::size_t picture, const PaintOptions& options) const;
  bool is_veil(std::size_t picture, const PaintOptions& options) const;
  enum class Layer { solid, veil };
  void draw_bodies(const ViewModel& model, const Camera& camera, const PaintOptions& options,
                   const PixelBox& area, Layer layer);
  void draw_body(std::size_t picture, const BodyPicture& body, const Camera& camera,
                 const PaintOptions& options, int height);
  void draw_planes(const ViewModel& model, const Camera& camera);

  const Scene& scene_;
  int samples_;
  std::unique_ptr<Framebuffer> kept_;  // what was drawn
  std::optional<Seen> seen_;           // when it was
  PixelBoxes drawn_;
  LitProgram at_pixels_{Lighting::at_pixels};
  LitProgram at_vertices_{Lighting::at_vertices};
  LitProgram as_beads_{Lighting::as_beads};
  LitProgram as_lines_{Lighting::as_lines};
  BackdropDrawing backdrop_;
  std::size_t first_section_, first_inside_;             // behind bodies and connections
  std::vector<std::size_t> with_section_, with_inside_;  // bodies
  std::vector<TissueDrawing> bodies_;  // of all pictures: bodies, connections, sections, what lies inside
  std::vector<std::unique_ptr<ToolDrawing>> tools_;
  std::vector<Touch> touches_;
  double size_ = 0;  // half the diagonal of all bodies [m]
  double metres_per_newton_ = 0;
  ColourScale colour_scale_;
  std::size_t bytes_uploaded_ = 0;
};

}  // namespace palpate::render
