#include "render_node/gl/tool_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "common/scene/force_model.h"
#include "render_node/view/line_of_action.h"

namespace palpate::render {
namespace {

const Eigen::Vector3f steel(0.74F, 0.77F, 0.82F);
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

/// In pieces along z: a long thing that lies across the picture covers little of the rectangle round it.
void add_pieces(const Lens& lens, const Eigen::AlignedBox3f& box, const Eigen::Matrix4f& pose,
                PixelBoxes& pixels) {
  constexpr int n = 12;
  Eigen::AlignedBox3f piece = box;
  for (int i = 0; i < n; ++i) {
    const auto at = [&box](int k) { return box.min().z() + box.sizes().z() * static_cast<float>(k) / n; };
    piece.min().z() = at(i);
    piece.max().z() = at(i + 1);
    pixels.add(pixels_of(lens, piece, pose));
  }
}

}  // namespace

ToolDrawing::ToolDrawing(const ToolSpec& spec, const DeviceSpec& device, std::optional<std::size_t> body)
    : shape_(spec.shape),
      body_(body),
      radius_(spec.radius),
      axis_(stick_axis(device)),
      force_limit_(device.force_limit),
      at_hand_(body || force_model_of(spec) == ForceModel::direct) {
  const Eigen::Vector3d up = spec.attitude * Eigen::Vector3d::UnitZ();
  if (is_solid_tip(spec.shape)) {
    attitude_ = spec.attitude;
    size_ = spec.size;
    axis_ = up;
    length_ = spec.shape == ToolShape::box ? size_.z() : spec.length;
  }
  if (cuts(spec)) {
    attitude_ = spec.attitude;
    scissors_ = spec.scissors;
    axis_ = up;
    length_ = spec.length;
    edge_ = spec.edge;
  }
  if (spec.shape == ToolShape::needle) {
    axis_ = up;
    length_ = spec.length;
  }
  if (spec.shape == ToolShape::stick) {
    axis_ = -up;  // B = A - L R e_z, as physics has it
    length_ = spec.length;
  }
}

void ToolDrawing::shape(double size) {
  const auto radius = static_cast<float>(radius_);
  const auto length = static_cast<float>(length_);
  if (shape_ == ToolShape::box)
    stick_.shape_box(size_.cast<float>());
  else if (shape_ == ToolShape::scalpel)
    stick_.shape_blade(length, static_cast<float>(edge_));
  else if (shape_ == ToolShape::scissors)
    stick_.shape_scissor(length, static_cast<float>(scissors_.offset), false),
        other_.shape_scissor(length, static_cast<float>(scissors_.offset), true);
  else if (shape_ == ToolShape::needle)
    stick_.shape(needle_outline(radius, length));
  else if (shape_ == ToolShape::cylinder)
    stick_.shape(cylinder_outline(radius, length));
  else if (shape_ == ToolShape::cone)
    stick_.shape(cone_outline(radius, length));
  else
    stick_.shape(length_ > 0 ? capsule_outline(radius, length)
                             : stick_outline(radius, static_cast<float>(1.2 * size)));
}

void ToolDrawing::place(const ToolView& view, const ViewModel& model, const Wanted& wanted) {
  placed_ = {};
  touch_.reset();
  if (!view.tip || wanted.size <= 0) return;
  const Eigen::Vector3d at = at_hand_ ? *view.tip : view.proxy;
  const Eigen::Vector3d axis = length_ > 0 ? Eigen::Vector3d(view.attitude * axis_) : axis_;
  placed_.wire = wanted.wire;
  if (wanted.tool && !body_) {
    placed_.stick = pose_along(at, axis);
    if (shape_ == ToolShape::box || shape_ == ToolShape::scalpel)
      placed_.stick->topLeftCorner<3, 3>() = (view.attitude * attitude_).cast<float>();
    if (shape_ == ToolShape::scissors) place_blades(at, view);
  }
  const bool presses = view.n_contacts > 0 && view.force.norm() > 0;
  const double length = wanted.force ? view.force.norm() * wanted.metres_per_newton : 0;
  const bool pointed = length >= 1e-3 * wanted.size;  // a shorter one points nowhere
  const Eigen::Vector3d pushed = presses || pointed ? pushed_at(view, model, at, axis) : at;
  if (pointed) {
    placed_.arrow_length = static_cast<float>(length);
    placed_.arrow = pose_along(pushed, view.force.normalized());
    arrow_.shape(arrow_outline(static_cast<float>(0.018 * wanted.size), placed_.arrow_length));
  }
  if (!wanted.tool || (body_ && !presses)) return;
  // Why: a thin tool's own radius would be too small to see.
  const double radius = body_ ? 0.05 * wanted.size : std::max(radius_, 0.03 * wanted.size);
  touch_ = {(presses ? pushed : at).cast<float>(), static_cast<float>(radius), presses};
}

/// Open as far as physics says, the pivot above the tip where the tips meet when they are closed.
void ToolDrawing::place_blades(const Eigen::Vector3d& tip, const ToolView& view) {
  const double closed = scissors_.closed_crossing();
  const double half = 0.5 * scissors_.angle(closed + std::min(0.0, view.stretch));
  Eigen::Isometry3d pivot = Eigen::Isometry3d::Identity();
  pivot.linear() = (view.attitude * attitude_).matrix();
  pivot.translation() = tip + closed * pivot.linear().col(2);
  const auto turned = [&](double by) -> Eigen::Matrix4f {
    return (pivot * Eigen::AngleAxisd(by, Eigen::Vector3d::UnitY())).matrix().cast<float>();
  };
  placed_.stick = turned(-half);
  placed_.other = turned(half);
}

/// Where tissue pushes a tool that is drawn with its tip at `at`. A point is pushed there; of a body and of a stick the wrench
/// says the line of action, which is moved as the drawn tool is.
Eigen::Vector3d ToolDrawing::pushed_at(const ToolView& view, const ViewModel& model,
                                       const Eigen::Vector3d& at, const Eigen::Vector3d& axis) const {
  if (!body_ && length_ <= 0) return at;
  auto line = line_of_action(view.force, view.moment, view.set_point);
  if (!line) return at;
  if (body_) return pushed_point(*line, model.bodies()[*body_].surface()).value_or(at);
  line->point += at - view.tip_in_tissue;
  return pushed_point(*line, at, at + length_ * axis, radius_);
}

void ToolDrawing::draw(const LitProgram& program) const {
  if (placed_.stick) {
    if (placed_.wire) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    program.finish(0.30F, 1.0F);
    stick_.draw(program, *placed_.stick, steel);
    if (placed_.other) other_.draw(program, *placed_.other, steel);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  }
  if (!placed_.arrow) return;
  program.finish(0.05F, 1.0F);
  arrow_.draw(program, *placed_.arrow, arrow_colour);
  // Once more, paler, where something hides it: it begins at the tool's own surface, often behind it.
  program.finish(0.0F, 0.75F);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  arrow_.draw(program, *placed_.arrow, arrow_colour);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
}

PixelBoxes ToolDrawing::changed_pixels(const Lens& lens) {
  PixelBoxes now;
  if (placed_.stick) add_pieces(lens, stick_.box(), *placed_.stick, now);
  if (placed_.other) add_pieces(lens, other_.box(), *placed_.other, now);
  if (placed_.arrow) add_pieces(lens, arrow_.box(), *placed_.arrow, now);
  PixelBoxes changed;
  if (placed_ != seen_) {
    changed.add(seen_pixels_);
    changed.add(now);
  }
  seen_ = placed_;
  seen_pixels_ = now;
  return changed;
}

}  // namespace palpate::render
