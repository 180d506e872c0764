#pragma once
// Draws the whole picture but for the panels, in this order: gradient, bodies, tools, arrows, floor, walls, and then tissue
// that is not opaque.
// Needs a current OpenGL 3.3 context from construction to destruction.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/scene_fwd.h"
#include "common/scene/tool_spec.h"
#include "render_node/gl/backdrop_drawing.h"
#include "render_node/gl/lit_program.h"
#include "render_node/gl/solid_drawing.h"
#include "render_node/gl/tissue_drawing.h"
#include "render_node/model/view_model.h"
#include "render_node/view/camera.h"
#include "render_node/view/colour_scale.h"
#include "render_node/view/hidden.h"

namespace palpate::render {

/// What of the scene's [render] table a hand may switch while it runs.
struct PaintOptions {
  bool tool = true, force = true, wire = false, fragments = false;
  ColourKind colour = ColourKind::own;      // what colours of tissue say
  std::optional<SectionSpec> section = {};  // across which bodies are shown cut open
  bool inside = false;                      // of images is shown
  float opacity = 1;                        // of tissue
  Hidden hidden = {};
};

class Painter {
 public:
  Painter(const Scene& scene, const ViewModel& model);

  /// Into the framebuffer bound now. Uploads what changed.
  /// @param width,height  of the framebuffer [px]
  void draw(ViewModel& model, const Camera& camera, const PaintOptions& options, int width, int height);

  double arrow_metres_per_newton() const noexcept { return metres_per_newton_; }  // 0: nothing seen yet
  /// What its colours say, where they were asked for.
  const ColourScale& colour_scale() const noexcept { return colour_scale_; }
  std::size_t bytes_uploaded() const noexcept { return bytes_uploaded_; }  // by the last draw()

 private:
  struct Tool {
    double radius = 0;     // of the tip [m]
    Eigen::Vector3d axis;  // from the tip up the stick, unit; of a stick, where the handle is not turned
    double length = 0;     // of the stick, or what it is instead [m]; 0: as the picture needs
    ToolShape shape = ToolShape::point;
    double edge = 0;                                         // of a scalpel: from its handle [rad]
    Eigen::Vector3d size = Eigen::Vector3d::Zero();          // of a box [m]
    Eigen::Matrix3d attitude = Eigen::Matrix3d::Identity();  // of a box, where the handle is not turned
    double force_limit = 0;                                  // of its device [N]
    std::optional<std::size_t> body;                         // that it is, drawn as such, without a stick
    bool at_hand = false;                                    // is where the hand is, not at the proxy
    SolidDrawing stick, arrow;
  };
  void adapt_sizes(const Eigen::AlignedBox3d& box);
  void find_touches(const ViewModel& model, const PaintOptions& options);
  void follow_colours(const ViewModel& model, const PaintOptions& options);
  bool is_tissue(std::size_t picture) const;
  bool is_shown(std::size_t picture, const PaintOptions& options) const;
  bool is_veil(std::size_t picture, const PaintOptions& options) const;
  enum class Layer { solid, veil };
  void draw_bodies(ViewModel& model, const Camera& camera, const PaintOptions& options, int height,
                   Layer layer);
  void draw_body(std::size_t picture, const BodyPicture& body, const Camera& camera,
                 const PaintOptions& options, int height);
  void draw_planes(const ViewModel& model, const Camera& camera);
  void draw_tool(Tool& tool, const ToolView& view, const ViewModel& model, const PaintOptions& options);
  Eigen::Vector3d pushed_at(const Tool& tool, const ToolView& view, const ViewModel& model,
                            const Eigen::Vector3d& at, const Eigen::Vector3d& axis) const;
  void draw_arrow(Tool& tool, const Eigen::Vector3d& from, const Eigen::Vector3d& force);

  const Scene& scene_;
  LitProgram at_pixels_{Lighting::at_pixels};
  LitProgram at_vertices_{Lighting::at_vertices};
  LitProgram as_beads_{Lighting::as_beads};
  LitProgram as_lines_{Lighting::as_lines};
  BackdropDrawing backdrop_;
  std::size_t first_section_, first_inside_;             // behind bodies and connections
  std::vector<std::size_t> with_section_, with_inside_;  // bodies
  std::vector<TissueDrawing> bodies_;  // of all pictures: bodies, connections, sections, what lies inside
  std::vector<Tool> tools_;
  std::vector<Touch> touches_;
  double size_ = 0;  // half the diagonal of all bodies [m]
  double metres_per_newton_ = 0;
  ColourScale colour_scale_;
  std::size_t bytes_uploaded_ = 0;
};

}  // namespace palpate::render
