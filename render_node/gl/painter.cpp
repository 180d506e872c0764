#include "render_node/gl/painter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/inside_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"
#include "render_node/view/arrow_scale.h"

namespace palpate::render {
namespace {

constexpr float bead_radius = 0.16F;  // of the length of an element

Lens lens_of(const Camera& camera, int width, int height) {
  return {(camera.projection() * camera.view()).cast<float>(), width, height, camera.eye().cast<float>()};
}

}  // namespace

Painter::Painter(const Scene& scene, const ViewModel& model, int samples)
    : scene_(scene),
      samples_(samples),
      first_section_(scene.bodies.size() + scene.connections.size()),
      first_inside_(first_section_ + bodies_with_section(scene).size()),
      with_section_(bodies_with_section(scene)),
      with_inside_(bodies_with_inside(scene)),
      bodies_(model.bodies().size()) {
  for (const ToolSpec& tool : scene.tools) {
    std::optional<std::size_t> body;
    for (std::size_t b = 0; tool.shape == ToolShape::body && b < scene.bodies.size(); ++b)
      if (scene.bodies[b].name == tool.body) body = b;
    tools_.push_back(std::make_unique<ToolDrawing>(tool, scene.device(tool.device), body));
  }
}

void Painter::adapt_sizes(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty() || box.diagonal().norm() / 2 == size_) return;
  size_ = box.diagonal().norm() / 2;
  double limit = 0;
  for (auto& tool : tools_) {
    tool->shape(size_);
    limit = std::max(limit, tool->force_limit());
  }
  if (limit > 0 && size_ > 0) metres_per_newton_ = palpate::render::arrow_metres_per_newton(limit, size_);
}

void Painter::draw(ViewModel& model, const Camera& camera, const PaintOptions& options, int width,
                   int height) {
  GLint target = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  // 1. what there is to see
  model.refresh();
  adapt_sizes(model.box());
  follow_colours(model, options);
  upload(model, options);
  const std::vector<Touch> touched_before = std::move(touches_);
  place_tools(model, options);
  // 2. where it differs from what was drawn
  if (!kept_ || kept_->width() != width || kept_->height() != height) {
    kept_ = std::make_unique<Framebuffer>(width, height, samples_);
    seen_.reset();
  }
  Seen now{lens_of(camera, width, height), options, size_, colour_scale_.most()};
  drawn_ = changed_pixels(model, now.lens, options);
  add_touched_pixels(now.lens, touched_before, drawn_);
  // Why lines: within a rectangle they are drawn over other pixels than across all of it.
  if (seen_ != now || (drawn_.pixels() > 0 && has_lines(model, options))) drawn_.add(all_pixels(now.lens));
  seen_ = std::move(now);
  // 3. draw those parts of it
  drawn_.for_each([&](const PixelBox& area) { draw_area(model, camera, options, area); });
  kept_->copy_to(static_cast<unsigned>(target));
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(target));
  glViewport(0, 0, width, height);
}

void Painter::draw_area(const ViewModel& model, const Camera& camera, const PaintOptions& options,
                        const PixelBox& area) {
  kept_->bind();
  glViewport(0, 0, kept_->width(), kept_->height());
  glEnable(GL_SCISSOR_TEST);
  glScissor(area.x0, area.y0, area.width(), area.height());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glClear(GL_DEPTH_BUFFER_BIT);
  draw_bodies(model, camera, options, area, Layer::solid);
  at_pixels_.begin(camera);
  for (const auto& tool : tools_) tool->draw(at_pixels_);
  backdrop_.draw_gradient();
  draw_planes(model, camera);
  if (options.opacity < 1) draw_bodies(model, camera, options, area, Layer::veil);
  glDisable(GL_SCISSOR_TEST);  // which would hold for what follows, too
  kept_->resolve(area);
}

/// Each body says what of it changed since it was last drawn; one that is shown only now is a change of options.
PixelBoxes Painter::changed_pixels(const ViewModel& model, const Lens& lens, const PaintOptions& options) {
  PixelBoxes pixels;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!is_shown(model, i, options)) continue;
    if (const auto changed = bodies_[i].changed_pixels(lens, is_opened(i, options), options.wire))
      pixels.add(*changed);
    else
      pixels.add(all_pixels(lens));
  }
  for (const auto& tool : tools_) pixels.add(tool->changed_pixels(lens));
  return pixels;
}

/// Where tools darken surfaces otherwise than before. Light is computed at the corners of a facet, if not at every pixel: so it
/// reaches an edge further.
void Painter::add_touched_pixels(const Lens& lens, const std::vector<Touch>& before,
                                 PixelBoxes& pixels) const {
  float edge = 0;
  for (const TissueDrawing& body : bodies_) edge = std::max(edge, body.longest_edge());
  const auto around = [edge, &lens](const Touch& touch) {
    const Eigen::Vector3f reach = Eigen::Vector3f::Constant(touch_reach * touch.radius + edge);
    return pixels_of(lens, {touch.at - reach, touch.at + reach});
  };
  for (std::size_t i = 0; i < std::max(before.size(), touches_.size()); ++i) {
    if (i < before.size() && i < touches_.size() && before[i] == touches_[i]) continue;
    if (i < before.size()) pixels.add(around(before[i]));
    if (i < touches_.size()) pixels.add(around(touches_[i]));
  }
}

void Painter::draw_planes(const ViewModel& model, const Camera& camera) {
  if (size_ <= 0) return;
  const double cell = 2 * palpate::render::arrow_metres_per_newton(1.0, size_ / 4);
  const Vec3 middle = model.box().center();
  if (scene_.floor)
    backdrop_.draw_plane(camera, middle, {0, 0, scene_.floor->height}, Vec3::UnitZ(), cell, 5 * size_);
  for (const WallSpec& wall : scene_.walls)
    backdrop_.draw_plane(camera, middle, wall.point, wall.normal, cell, 3 * size_);
}

/// Not a tool, nor the strands between bodies: these have no place at rest.
bool Painter::is_tissue(std::size_t picture) const {
  const std::size_t n = scene_.bodies.size();
  const std::size_t body = picture < n                ? picture
                           : picture < first_section_ ? n
                           : picture < first_inside_  ? with_section_[picture - first_section_]
                                                      : with_inside_[picture - first_inside_];
  return body < n && std::ranges::none_of(tools_, [body](const auto& tool) { return tool->body() == body; });
}

/// Not opaque, where the person wants tissue so.
bool Painter::is_veil(std::size_t picture, const PaintOptions& options) const {
  return options.opacity < 1 && !options.wire && picture < first_section_ && is_tissue(picture);
}

/// Cut by the section, so that its inside shows.
bool Painter::is_opened(std::size_t picture, const PaintOptions& options) const {
  return options.section && is_tissue(picture) && (picture < first_section_ || picture >= first_inside_);
}

/// The section of a body is shown with it, and its inside where anything may be seen of it.
bool Painter::is_shown(const ViewModel& model, std::size_t picture, const PaintOptions& options) const {
  if (model.bodies()[picture].empty()) return false;
  if (picture < first_section_) return !is_hidden(options.hidden.bodies, picture);
  if (picture >= first_inside_)
    return options.inside && is_tissue(picture) &&
           (options.opacity < 1 || options.section || options.wire ||
            is_hidden(options.hidden.bodies, with_inside_[picture - first_inside_]));
  return options.section && is_tissue(picture) &&
         !is_hidden(options.hidden.bodies, with_section_[picture - first_section_]);
}

void Painter::follow_colours(const ViewModel& model, const PaintOptions& options) {
  if (options.colour == ColourKind::own) return;
  colour_scale_.show(options.colour);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (is_tissue(i) && is_shown(model, i, options))
      colour_scale_.see(static_cast<double>(is_of_physics(options.colour) ? model.bodies()[i].most_field()
                                                                          : model.bodies()[i].farthest()));
}

bool Painter::has_lines(const ViewModel& model, const PaintOptions& options) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (is_shown(model, i, options) && bodies_[i].has_lines()) return true;
  return options.wire;
}

void Painter::upload(ViewModel& model, const PaintOptions& options) {
  bytes_uploaded_ = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (is_shown(model, i, options)) bytes_uploaded_ += bodies_[i].upload(model.bodies()[i]);
}

/// Solid ones first. Of those that are a veil only the nearest surface is seen: its depth is drawn before it is.
void Painter::draw_bodies(const ViewModel& model, const Camera& camera, const PaintOptions& options,
                          const PixelBox& area, Layer layer) {
  const int height = kept_->height();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!is_shown(model, i, options)) continue;
    if (is_veil(i, options) != (layer == Layer::veil)) continue;
    const BodyPicture& body = model.bodies()[i];
    bodies_[i].look_at(area);
    if (layer == Layer::solid) {
      draw_body(i, body, camera, options, height);
      continue;
    }
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_body(i, body, camera, options, height);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw_body(i, body, camera, options, height);
    glDisable(GL_BLEND);
  }
}

void Painter::draw_body(std::size_t i, const BodyPicture& body, const Camera& camera,
                        const PaintOptions& options, int height) {
  const float shade = options.fragments ? 0.5F : 1.0F;
  TissueDrawing& drawing = bodies_[i];
  const bool opened = is_opened(i, options);
  const LitProgram& lit = drawing.closed() && drawing.dense() && !opened ? at_vertices_ : at_pixels_;
  lit.begin(camera);
  if (opened) {
    lit.cut_open(section_cut(*options.section, camera.eye()));
    glEnable(GL_CLIP_DISTANCE0);
  }
  lit.shade(options.wire ? 0.0F : shade);
  lit.pale(options.wire ? 0.75F : 0.0F);
  if (i < first_section_) lit.touched(touches_);  // else it would darken what the section is to show
  const auto most = static_cast<float>(colour_scale_.most());
  if (options.colour == ColourKind::displacement && is_tissue(i)) lit.colour_by_way(most);
  if (is_of_physics(options.colour) && is_tissue(i)) lit.colour_by_field(most);
  glEnable(GL_POLYGON_OFFSET_FILL);  // lines lie before the surface
  glPolygonOffset(1, 1);
  drawing.draw(lit, is_veil(i, options) ? options.opacity : 1.0F);
  glDisable(GL_POLYGON_OFFSET_FILL);
  if (options.wire || drawing.has_lines()) {
    as_lines_.begin(camera);
    as_lines_.shade(shade);
    if (opened) as_lines_.cut_open(section_cut(*options.section, camera.eye()));
    drawing.draw_lines(as_lines_, body, options.wire);
  }
  if (drawing.has_beads()) {
    as_beads_.begin(camera);
    as_beads_.shade(shade);
    if (opened) as_beads_.cut_open(section_cut(*options.section, camera.eye()));
    as_beads_.size_beads(camera, bead_radius * body.edge_length(), height);
    drawing.draw_beads(as_beads_);
  }
  glDisable(GL_CLIP_DISTANCE0);
}

void Painter::place_tools(const ViewModel& model, const PaintOptions& options) {
  touches_.clear();
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const bool shown = !is_hidden(options.hidden.tools, i);
    tools_[i]->place(
        model.tools()[i], model,
        {options.tool && shown, options.force && shown, options.wire, size_, metres_per_newton_});
    if (tools_[i]->touch() && touches_.size() < most_touches) touches_.push_back(*tools_[i]->touch());
  }
}

}  // namespace palpate::render
