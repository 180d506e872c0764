#include "render_node/gl/painter.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/force_model.h"
#include "common/scene/inside_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"
#include "render_node/view/arrow_scale.h"
#include "render_node/view/line_of_action.h"

namespace palpate::render {
namespace {

const Eigen::Vector3f steel(0.74F, 0.77F, 0.82F);
constexpr float bead_radius = 0.16F;  // of the length of an element
const Eigen::Vector3f arrow_colour(1.0F, 0.45F, 0.10F);

// The stick points back along the first way that a scripted hand goes, which is towards tissue, leaning a little so that it does not
// hide the arrow.
Eigen::Vector3d stick_axis(const DeviceSpec& device) {
  constexpr double least_way = 1e-3;  // Why: shorter ones settle a hand and lead nowhere [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  for (const auto& waypoint : device.waypoints) {
    const Eigen::Vector3d way = device.waypoints.front().p - waypoint.p;
    if (way.norm() < least_way) continue;
    axis = way.normalized();
    break;
  }
  const Eigen::Vector3d side = axis.unitOrthogonal();
  return (axis + 0.45 * (std::abs(axis.z()) > 0.9 ? side : Eigen::Vector3d::UnitZ())).normalized();
}

}  // namespace

Painter::Painter(const Scene& scene, const ViewModel& model)
    : scene_(scene),
      first_section_(scene.bodies.size() + scene.connections.size()),
      first_inside_(first_section_ + bodies_with_section(scene).size()),
      with_section_(bodies_with_section(scene)),
      with_inside_(bodies_with_inside(scene)),
      bodies_(model.bodies().size()),
      tools_(scene.tools.size()) {
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const auto& device = scene.device(scene.tools[i].device);
    tools_[i].radius = scene.tools[i].radius;
    tools_[i].axis = stick_axis(device);
    tools_[i].shape = scene.tools[i].shape;
    if (is_solid_tip(scene.tools[i].shape)) {
      tools_[i].attitude = scene.tools[i].attitude;
      tools_[i].size = scene.tools[i].size;
      tools_[i].axis = scene.tools[i].attitude * Eigen::Vector3d::UnitZ();
      tools_[i].length = scene.tools[i].shape == ToolShape::box ? tools_[i].size.z() : scene.tools[i].length;
    }
    if (scene.tools[i].shape == ToolShape::scalpel) {
      tools_[i].attitude = scene.tools[i].attitude;
      tools_[i].axis = scene.tools[i].attitude * Eigen::Vector3d::UnitZ();
      tools_[i].length = scene.tools[i].length;
      tools_[i].edge = scene.tools[i].edge;
    }
    if (scene.tools[i].shape == ToolShape::needle) {
      tools_[i].axis = scene.tools[i].attitude * Eigen::Vector3d::UnitZ();
      tools_[i].length = scene.tools[i].length;
    }
    if (scene.tools[i].shape == ToolShape::stick) {
      // B = A - L R e_z, as physics has it.
      tools_[i].axis = -(scene.tools[i].attitude * Eigen::Vector3d::UnitZ());
      tools_[i].length = scene.tools[i].length;
    }
    tools_[i].force_limit = device.force_limit;
    for (std::size_t b = 0; scene.tools[i].shape == ToolShape::body && b < scene.bodies.size(); ++b)
      if (scene.bodies[b].name == scene.tools[i].body) tools_[i].body = b;
    tools_[i].at_hand = tools_[i].body || force_model_of(scene.tools[i]) == ForceModel::direct;
  }
}

void Painter::adapt_sizes(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty() || box.diagonal().norm() / 2 == size_) return;
  size_ = box.diagonal().norm() / 2;
  double limit = 0;
  for (auto& tool : tools_) {
    const auto radius = static_cast<float>(tool.radius);
    const auto length = static_cast<float>(tool.length);
    if (tool.shape == ToolShape::box)
      tool.stick.shape_box(tool.size.cast<float>());
    else if (tool.shape == ToolShape::scalpel)
      tool.stick.shape_blade(length, static_cast<float>(tool.edge));
    else if (tool.shape == ToolShape::needle)
      tool.stick.shape(needle_outline(radius, length));
    else if (tool.shape == ToolShape::cylinder)
      tool.stick.shape(cylinder_outline(radius, length));
    else if (tool.shape == ToolShape::cone)
      tool.stick.shape(cone_outline(radius, length));
    else
      tool.stick.shape(tool.length > 0 ? capsule_outline(radius, length)
                                       : stick_outline(radius, static_cast<float>(1.2 * size_)));
    limit = std::max(limit, tool.force_limit);
  }
  if (limit > 0 && size_ > 0) metres_per_newton_ = palpate::render::arrow_metres_per_newton(limit, size_);
}

void Painter::draw(ViewModel& model, const Camera& camera, const PaintOptions& options, int width,
                   int height) {
  model.refresh();
  adapt_sizes(model.box());
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glClear(GL_DEPTH_BUFFER_BIT);
  backdrop_.draw_gradient();
  find_touches(model, options);
  follow_colours(model, options);
  bytes_uploaded_ = 0;
  draw_bodies(model, camera, options, height, Layer::solid);
  at_pixels_.begin(camera);
  for (std::size_t i = 0; i < tools_.size(); ++i)
    if (!is_hidden(options.hidden.tools, i)) draw_tool(tools_[i], model.tools()[i], model, options);
  draw_planes(model, camera);
  if (options.opacity < 1) draw_bodies(model, camera, options, height, Layer::veil);
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
  return body < n && std::ranges::none_of(tools_, [body](const Tool& tool) { return tool.body == body; });
}

/// Not opaque, where the person wants tissue so.
bool Painter::is_veil(std::size_t picture, const PaintOptions& options) const {
  return options.opacity < 1 && !options.wire && picture < first_section_ && is_tissue(picture);
}

/// The section of a body is shown with it, and its inside where anything may be seen of it.
bool Painter::is_shown(std::size_t picture, const PaintOptions& options) const {
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
    if (is_tissue(i) && is_shown(i, options))
      colour_scale_.see(static_cast<double>(is_of_physics(options.colour) ? model.bodies()[i].most_field()
                                                                          : model.bodies()[i].farthest()));
}

/// Solid ones first. Of those that are a veil only the nearest surface is seen: its depth is drawn before it is.
void Painter::draw_bodies(ViewModel& model, const Camera& camera, const PaintOptions& options, int height,
                          Layer layer) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyPicture& body = model.bodies()[i];
    if (body.empty() || !is_shown(i, options)) continue;
    if (is_veil(i, options) != (layer == Layer::veil)) continue;
    bytes_uploaded_ += bodies_[i].upload(body);
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
  const bool is_inside = i >= first_inside_;
  const bool opened = options.section && is_tissue(i) && (i < first_section_ || is_inside);
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
  drawing.draw(lit, opened, is_veil(i, options) ? options.opacity : 1.0F);
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

/// Tools that are shown, where they are or where tissue pushes them. A tool that is a body shades only where it is
/// pushed.
void Painter::find_touches(const ViewModel& model, const PaintOptions& options) {
  touches_.clear();
  for (std::size_t i = 0; options.tool && i < tools_.size() && touches_.size() < most_touches; ++i) {
    const Tool& tool = tools_[i];
    const ToolView& view = model.tools()[i];
    if (!view.tip || size_ <= 0 || is_hidden(options.hidden.tools, i)) continue;
    const bool presses = view.n_contacts > 0 && view.force.norm() > 0;
    if (tool.body && !presses) continue;
    const Eigen::Vector3d at = tool.at_hand ? *view.tip : view.proxy;
    const Eigen::Vector3d axis = tool.length > 0 ? Eigen::Vector3d(view.attitude * tool.axis) : tool.axis;
    const Eigen::Vector3d where = presses ? pushed_at(tool, view, model, at, axis) : at;
    // Why: a thin tool's own radius would be too small to see.
    const double radius = tool.body ? 0.05 * size_ : std::max(tool.radius, 0.03 * size_);
    touches_.push_back({where.cast<float>(), static_cast<float>(radius), presses});
  }
}

/// Where tissue pushes a tool that is drawn with its tip at `at`. A point is pushed there; of a body and of a stick the wrench
/// says the line of action, which is moved as the drawn tool is.
Eigen::Vector3d Painter::pushed_at(const Tool& tool, const ToolView& view, const ViewModel& model,
                                   const Eigen::Vector3d& at, const Eigen::Vector3d& axis) const {
  if (!tool.body && tool.length <= 0) return at;
  auto line = line_of_action(view.force, view.moment, view.set_point);
  if (!line) return at;
  if (tool.body) return pushed_point(*line, model.bodies()[*tool.body].surface()).value_or(at);
  line->point += at - view.tip_in_tissue;
  return pushed_point(*line, at, at + tool.length * axis, tool.radius);
}

// As the papers show it, a tool rests on the surface where its proxy is, however far beneath the hand has gone.
void Painter::draw_tool(Tool& tool, const ToolView& view, const ViewModel& model,
                        const PaintOptions& options) {
  if (!view.tip || size_ <= 0) return;
  const Eigen::Vector3d at = tool.at_hand ? *view.tip : view.proxy;
  const Eigen::Vector3d axis = tool.length > 0 ? Eigen::Vector3d(view.attitude * tool.axis) : tool.axis;
  if (options.tool && !tool.body) {
    if (options.wire) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    at_pixels_.finish(0.30F, 1.0F);
    Eigen::Matrix4f pose = pose_along(at, axis);
    if (tool.shape == ToolShape::box || tool.shape == ToolShape::scalpel)
      pose.topLeftCorner<3, 3>() = (view.attitude * tool.attitude).cast<float>();
    tool.stick.draw(at_pixels_, pose, steel);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  }
  if (options.force) draw_arrow(tool, pushed_at(tool, view, model, at, axis), view.force);
}

void Painter::draw_arrow(Tool& tool, const Eigen::Vector3d& from, const Eigen::Vector3d& force) {
  const double length = force.norm() * metres_per_newton_;
  if (length < 1e-3 * size_) return;  // too short to point anywhere
  tool.arrow.shape(arrow_outline(static_cast<float>(0.018 * size_), static_cast<float>(length)));
  const Eigen::Matrix4f pose = pose_along(from, force.normalized());
  at_pixels_.finish(0.05F, 1.0F);
  tool.arrow.draw(at_pixels_, pose, arrow_colour);
  // Once more, paler, where something hides it: it begins at the tool's own surface, often behind it.
  at_pixels_.finish(0.0F, 0.75F);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  tool.arrow.draw(at_pixels_, pose, arrow_colour);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
}

}  // namespace palpate::render
