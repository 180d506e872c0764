#include "physics_node/contact/tissue_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/error/error.h"
#include "common/message/vec3.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/secant_stiffness.h"

namespace palpate::physics {
namespace {

constexpr double lets_go_in = 0.2;       // after silence [s]
constexpr double rest_smoothing = 5e-3;  // of what modes do not tell [s]
constexpr double smallest_patch = 0.25;  // of the radius: where a touch begins
constexpr double smallest_shape = 1e-9;  // of a mode that the tip does not feel [kg^-1/2]

void refuse_coarse(const ToolSpec& tool, const Body& body) {
  if (FacePress::is_resolved(tool.radius, body.spacing())) return;
  throw InputError(
      tool.place.text() +
      fmt::format(": force_model = \"tissue\" presses a sphere on the faces of \"{}\", whose cells of "
                  "{:.3g} mm do not follow one of radius_mm = {:.3g}; write spacing_mm = {:.3g} or less, "
                  "or a larger radius",
                  body.name, 1e3 * body.spacing(), 1e3 * tool.radius, 2e3 * tool.radius));
}

}  // namespace

TissueTool::TissueTool(const ToolSpec& tool, std::uint32_t index, const std::vector<TouchableBody>& bodies,
                       double period, Integrator integrator, const Crew& crew)
    : PressingTool(index, tool.set_point), radius_(tool.radius), integrator_(integrator), play_(period) {
  for (const auto& body : bodies) {
    const Body& shape = body.moving->body();
    refuse_coarse(tool, shape);
    bodies_.push_back(std::make_unique<Touchable>(
        Touchable{body.moving, ToolContact(*body.surface, *body.moving, tool.radius),
                  FacePress(*body.surface, *body.moving, RigidShape::sphere(tool.radius)),
                  BodyModes(shape, static_cast<int>(max_tissue_modes), crew)}));
  }
  candidates_.reserve(FacePress::most_facets);
}

void TissueTool::let_go() noexcept {
  force_ = 0;
  if (touched_ < bodies_.size()) bodies_[touched_]->faces.release();
}

void TissueTool::reset() noexcept {
  let_go();
  play_.reset();
  engaged_ = found_ = false;
  keep_ = 1;
  told_at_ = 0;
  normal_.setZero();
}

void TissueTool::take(const ToolState* state, double dt) noexcept {
  frame_dt_ = dt;
  elapsed_ = 0;
  if (!play_.take(state)) let_go(), told_at_ = 0;
  // What was let go takes hold again as it went.
  keep_ = std::clamp(keep_ + (state == nullptr ? -dt : dt) / lets_go_in, 0.0, 1.0);
  if (state == nullptr) return;
  note(*state);
  engaged_ = state->engaged != 0;
  spring_.stiffness = state->stiffness;
  spring_.damping = state->damping;
  spring_.most = state->force_limit;
}

void TissueTool::find_contact(double t) noexcept {
  found_ = false;
  if (!play_.seen() || bodies_.empty()) return let_go();
  hand_ = play_.at(0);
  // The sphere stays in the tissue when the hand goes deeper than its spring lets it.
  const Vec3 tip = force_ > 0 ? Vec3(hand_.x - depth_ * pose_.normal()) : hand_.x;
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = touched_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    bodies_[b]->contact.look(tip, t);
    const double distance = bodies_[b]->contact.nearest_distance(tip);
    if (distance < least) least = distance, nearest = b;
  }
  if (!std::isfinite(least)) return let_go();
  if (nearest != touched_) let_go(), touched_ = nearest, told_at_ = 0;
  Touchable& body = *bodies_[touched_];
  plane_ = body.contact.plane_under(tip);
  if (!plane_.found) return let_go();
  found_ = true;
  const bool at_rest = remembers_rest(body.moving->body()) && !plane_.rest_normal.isZero();
  pose_ = pose_along(hand_.x, at_rest ? plane_.rest_normal : plane_.normal);
  if (!at_rest) plane_.rest = plane_.point;
  if (force_ <= 0) body.contact.find_shares(tip);
  candidates_.clear();
  body.contact.facets_within(tip, body.faces.reach() + play_.way(), candidates_);
  body.faces.list(pose_, candidates_, play_.way());
  if (force_ > 0) return;
  depth_ = body.faces.depth();
  if (!std::isfinite(depth_)) let_go(), found_ = false;  // no face is near
}

void TissueTool::begin_step() noexcept {
  if (found_) bodies_[touched_]->faces.note_velocities(integrator_ == Integrator::velocity_verlet);
}

double TissueTool::press(double dt) noexcept {
  if (!found_) return 0;
  FacePress& faces = bodies_[touched_]->faces;
  elapsed_ += dt;
  const HandPlay::Moment now = play_.at(elapsed_ / frame_dt_);
  const Vec3& n = pose_.normal();
  const double way = (hand_.x - now.x).dot(n);
  hand_ = now;
  pose_.tip = now.x;
  PressBy by = spring_;
  by.stiffness *= keep_, by.damping *= keep_;
  by.dt = dt;
  // p' = v - z_w', z_w' = (way + z - z_before) / dt the sphere's own speed.
  const double before = force_ > 0 ? depth_ : 0;
  by.lead = -now.v.dot(n) + (before - way) / dt;
  if (force_ > 0)
    faces.shift(-way);
  else
    depth_ -= way;
  force_ = 0;
  if (!engaged_ || !faces.press(pose_, by, dt)) {
    faces.release();
    return 0;
  }
  depth_ = faces.depth();
  force_ = by.at(depth_);
  faces.spread(-force_ * n);
  return faces.power_before();
}

TissueTool::Modal TissueTool::find_shapes(const Touchable& body) const noexcept {
  Modal phi{};
  const Vec3 into = -pose_.normal();
  for (std::size_t i = 0; i < body.modes.size(); ++i) {
    if (forces().empty())
      for (const MassShare& share : body.contact.shares())
        phi[i] += share.share * into.dot(body.modes.shape(i, share.cell));
    else
      for (const NodalForce& nodal : forces())
        phi[i] += nodal.force.dot(body.modes.shape(i, nodal.cell)) / force_;
  }
  return phi;
}

/// Of a half space under what bears: 2 E a / (1 - nu^2) [N/m].
double TissueTool::stiffness_of_patch(const Touchable& body) const noexcept {
  const double a = std::max(smallest_patch * radius_, std::sqrt(body.faces.area() / std::numbers::pi));
  return half_space_stiffness(body.moving->body(), a);
}

/// Of modes signs do not matter: the copy has them with phi above 0.
void TissueTool::tell(TouchedTissue& tissue) noexcept {
  Touchable& body = *bodies_[touched_];
  const Modal phi = find_shapes(body);
  Told now;
  now.depth = (plane_.rest - hand_.x).dot(pose_.normal()) + depth_;
  now.force = force_;
  body.modes.measure(*body.moving, now.q, now.w);
  const double k = stiffness_of_patch(body);
  double modal = 0, moved = 0;
  for (std::size_t i = 0; i < body.modes.size(); ++i) {
    modal += phi[i] * now.q[i];
    moved += phi[i] * (now.q[i] - told_.q[i]);
  }
  const bool goes_on = told_at_ > 0 && now.force > 0 && told_.force > 0;
  // From the last frame's point: the depth it would have had from this one.
  const double shifted = (plane_.rest - point_).dot(pose_.normal());
  const double since = static_cast<double>(play_.sample() - told_at_) * play_.period();
  if (goes_on && since > 0)
    residual_.follow(k, now.force - told_.force, now.depth - told_.depth - shifted - moved, since);
  else if (now.force <= 0 || told_at_ == 0)
    residual_.begin(k);
  const double rest = now.depth - residual_.value() * now.force - modal;
  rest_ = goes_on ? rest_ + shifted - std::expm1(-since / rest_smoothing) * (rest - rest_ - shifted) : rest;
  told_ = now;
  told_at_ = play_.sample();
  point_ = plane_.rest;

  tissue.sample = told_at_;
  tissue.point = array(plane_.rest);
  tissue.normal = array(pose_.normal());
  tissue.residual = std::min(residual_.value(), most_compliance);
  tissue.rest = rest_;
  tissue.force = now.force;
  tissue.n_modes = static_cast<std::uint32_t>(body.modes.size());
  for (std::size_t i = 0; i < body.modes.size(); ++i) {
    const double sign = phi[i] < 0 ? -1 : 1;
    tissue.modes[i] = {std::max(sign * phi[i], smallest_shape), body.modes.omega2(i), body.modes.damping(i),
                       sign * now.q[i], sign * now.w[i]};
  }
  tissue.n_branches = 0;
}

void TissueTool::write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept {
  begin_patch(patch, frame, now_ns);
  patch.n_tissues = found_ && play_.sample() > 0 ? 1 : 0;
  if (patch.n_tissues == 0) {
    told_at_ = 0;
    return;
  }
  tell(patch.tissues[0]);
}

}  // namespace palpate::physics
