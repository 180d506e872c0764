#include "physics_node/contact/tissue_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "common/error/error.h"
#include "common/message/vec3.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/secant_stiffness.h"
#include "physics_node/contact/tip_lean.h"

namespace palpate::physics {
namespace {

// A touch begins outside: what is deeper in the tissue without bearing has got there otherwise, and would be thrown out.
constexpr double begins_within = 0.5e-3;  // [m]
// Of the shape's size: how deep a corner of the tissue may be in it before a sample of its faces is, where
// it has come from outside. Why: samples lie up to a twentieth of the size beside a corner, and in a hollow
// the shape is as steep as four to one.
constexpr double corner_before_sample = 0.2;
// Of what holds modes where their force does not: weight, what a body lies on, other tools, a law that is curved. Why: slower than a hand palpates.
constexpr double offset_smoothing = 0.1;   // [s]
constexpr int looks_around = 12;           // a frame; the next one goes on
constexpr double faces_within = 1 - 1e-6;  // cosine
constexpr double other_is_nearer =
    0.25;  // of the size: by how much another body has to be, to be touched instead
constexpr double comes_over_within = 0.1;  // after it has left another body [s]
constexpr double rest_smoothing = 5e-3;    // of what modes do not tell [s]
// Of the shape's size: where a touch begins. A stick lies on more than a ball does, a flat end on all of it.
constexpr double smallest_of_ball = 0.25, smallest_of_others = 1;
// Of a rigid patch on a half space, across its plane to along its normal: (2 - nu) / (2 - 2 nu), nu = 1/3.
constexpr double across_to_along = 1.25;

void refuse_coarse(const ToolSpec& tool, double size, const Body& body) {
  if (follows_shape(body.spacing(), size)) return;
  const bool boxes = tool.shape == ToolShape::box;
  throw InputError(
      tool.place.text() +
      fmt::format(
          ": force_model = \"tissue\" presses the tool on the faces of \"{}\", whose cells of "
          "{:.3g} mm do not follow one of {} = {:.3g}; write spacing_mm = {:.3g} or less, or a larger {}",
          body.name, 1e3 * body.spacing(), boxes ? "half a side" : "radius_mm", 1e3 * size, 2e3 * size,
          boxes ? "side" : "radius"));
}

/// Of what nothing holds none: it swings about where it goes, and what it lies on is not known to its modes. Of what is awake in parts none:
/// modes are of all of a body.
int modes_of(const Body& body) noexcept {
  return body.n_held > 0 && !is_awake_in_parts(body) ? static_cast<int>(max_tissue_modes) : 0;
}

}  // namespace

TissueTool::TissueTool(const ToolSpec& tool, std::uint32_t index, const std::vector<TouchableBody>& bodies,
                       double period, Integrator integrator, const Crew& crew)
    : PressingTool(index, tool.set_point),
      held_(held_shape(tool)),
      integrator_(integrator),
      play_(period),
      rubbing_(tool.friction) {
  for (const auto& body : bodies) {
    const Body& shape = body.moving->body();
    const double size = held_.shape.size();
    refuse_coarse(tool, size, shape);
    bodies_.push_back(std::make_unique<Touchable>(Touchable{
        body.moving,
        ToolContact(*body.surface, *body.moving, size, held_.turns() ? held_.half_diagonal() : 0.0),
        FacePress(*body.surface, *body.moving, held_.shape), BodyModes(shape, modes_of(shape), crew)}));
  }
  candidates_.reserve(FacePress::most_facets);
}

void TissueTool::let_go() noexcept {
  force_ = 0;
  on_tissue_.setZero();
  rubbing_.release();
  if (touched_ < bodies_.size()) bodies_[touched_]->faces.release();
}

void TissueTool::reset() noexcept {
  let_go();
  play_.reset();
  engaged_ = found_ = knows_up_ = comes_over_ = outside_ = false;
  left_for_ = comes_over_within;
  keep_ = 1;
  told_at_ = 0;
}

void TissueTool::take(const ToolState* state, double dt) noexcept {
  frame_dt_ = dt;
  elapsed_ = 0;
  if (!play_.take(state, dt)) let_go(), told_at_ = 0;
  keep_ = spring_left(keep_, state != nullptr, dt);
  if (state == nullptr) return;
  note(*state);
  engaged_ = state->engaged != 0;
  spring_.stiffness = state->stiffness;
  spring_.damping = state->damping;
  spring_.most = state->force_limit;
}

/// Puts the shape, without what presses it out of the tissue, where it is in the frame.
void TissueTool::place(double share) noexcept {
  hand_ = play_.at(share);
  pose_.tip = hand_.x + rubbing_.lag();
  if (!held_.turns()) {
    pose_.tip += held_.shape.size() * (up_ - pose_.normal());
    return;
  }
  const Eigen::Matrix3d axes = held_.axes(play_.attitude(share));
  pose_.tip = held_.origin(pose_.tip, axes);
  pose_.attitude = pose_.axes.transpose() * axes;
}

/// Out of contact the middle of a ball lies where it is farthest from the tissue: on a face above the tip, in a corner
/// between its walls.
void TissueTool::face(const Touchable& body, const Vec3& tip) noexcept {
  if (held_.turns()) return;
  const auto at = [&](const Vec3& up) {
    return body.faces.way_out(tip + held_.shape.size() * up, candidates_);
  };
  FacePress::WayOut here = at(up_);
  double step = 1;
  for (int n = 0; n < looks_around && std::isfinite(here.distance); ++n) {
    if (here.direction.dot(up_) > faces_within) return;
    const Vec3 up = (up_ + step * here.direction).normalized();
    const FacePress::WayOut there = at(up);
    if (std::isfinite(there.distance) && there.distance > here.distance)
      up_ = up, here = there;
    else
      step *= 0.5;
  }
}

/// The middle of a ball that slides comes to lie beside the tip where that is pressed, on a way as long as its radius. It
/// moves out of the tissue, so it gives no energy. @param slid  way of the hand across the normal [m]
void TissueTool::roll(double slid) noexcept {
  if (held_.turns()) return;
  const Vec3 up = up_ + std::min(1.0, slid / held_.shape.size()) * (pose_.normal() - up_);
  if (up.norm() > 0.1) up_ = up.normalized();
}

/// Finds the nearest body. @return a point of its surface, or near it, where the tool touches it or would
std::optional<Vec3> TissueTool::look(const Vec3& tip, double t) noexcept {
  const Eigen::Matrix3d axes = held_.axes(play_.attitude(0));
  const Vec3 origin = held_.origin(tip, axes), middle = origin + axes * held_.shape.bounds().center();
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = touched_;
  ToolContact::Nearest at;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    ToolContact& contact = bodies_[b]->contact;
    contact.look(held_.turns() ? middle : tip, t);
    const auto now = held_.turns() ? contact.nearest_to(held_.shape, origin, axes)
                                   : ToolContact::Nearest{contact.nearest_distance(tip), tip, tip};
    const double given = force_ > 0 && b == touched_ ? other_is_nearer * held_.shape.size() : 0.0;
    if (now.distance - given < least) least = now.distance - given, nearest = b, at = now;
  }
  if (!std::isfinite(least)) return std::nullopt;
  if (nearest != touched_) {
    // From one to the other the tip may come to lie deep in that.
    comes_over_ = left_for_ < comes_over_within;
    if (comes_over_) keep_ = 0;
    let_go(), touched_ = nearest, told_at_ = 0;
  }
  if (force_ > 0 && held_.turns()) return tip + arm_;
  arm_ = at.on_shape - tip;
  return at.point;
}

void TissueTool::find_contact(double t) noexcept {
  const bool knew_up = std::exchange(knows_up_, false), was_outside = std::exchange(outside_, false);
  const std::size_t before = touched_;
  left_for_ = force_ > 0 ? 0.0 : left_for_ + frame_dt_;
  if (left_for_ >= comes_over_within) comes_over_ = false;
  found_ = false;
  if (!play_.seen() || bodies_.empty()) return let_go();
  hand_ = play_.at(0);
  // The tool stays in the tissue when the hand goes deeper than its spring lets it.
  const bool touched = force_ > 0;  // of whatever body
  const Vec3 tip = touched ? tip_now() : hand_.x;
  const std::optional<Vec3> under = look(tip, t);
  if (!under) return let_go();
  Touchable& body = *bodies_[touched_];
  const double way = play_.way() + 2 * held_.half_diagonal() * play_.turn();
  candidates_.clear();
  body.contact.facets_within(tip, body.faces.reach() + way, candidates_);
  const LocalPlane plane = body.contact.plane_under(*under);
  const bool at_rest = remembers_rest(body.moving->body()) && !plane.rest_normal.isZero();
  guide_ = at_rest ? plane.rest_normal : plane.normal;
  // Of what has a flat face the pressure lies across that, however flat the tissue is.
  const RigidShape::Kind kind = held_.shape.kind();
  const bool round = kind != RigidShape::Kind::box && kind != RigidShape::Kind::cylinder;
  flat_ = plane.found && round ? plane.flat : 0;
  if (!touched) {
    if (!plane.found) return let_go();
    if (!knew_up) up_ = plane.normal;
    face(body, tip);
    pose_ = pose_along(hand_.x, held_.turns() ? plane.normal : up_);
  }
  found_ = knows_up_ = true;
  place(0);
  if (force_ <= 0) body.contact.find_shares(*under);
  body.faces.list(pose_, candidates_, way);
  if (force_ > 0) {
    outside_ = true;  // it comes from there
    return;
  }
  depth_ = body.faces.depth();
  const bool comes_in = was_outside && touched_ == before;
  const double deepest =
      comes_in ? std::max(begins_within, corner_before_sample * held_.shape.size()) : begins_within;
  if (!std::isfinite(depth_) || (!touched && !comes_over_ && -depth_ > deepest)) let_go(), found_ = false;
  outside_ = found_ && engaged_ && (comes_in || depth_ >= 0);
}

void TissueTool::begin_step() noexcept {
  if (found_) bodies_[touched_]->faces.note_motion(integrator_ == Integrator::velocity_verlet);
}

double TissueTool::press(double dt) noexcept {
  if (!found_) return 0;
  FacePress& faces = bodies_[touched_]->faces;
  elapsed_ += dt;
  const double share = elapsed_ / frame_dt_;
  const HandPlay::Moment now = play_.at(share);
  const Vec3 n = pose_.normal();
  const double way = (hand_.x - now.x).dot(n);
  if (force_ > 0) {
    rubbing_.lead(now.x - hand_.x, n);
    roll((now.x - hand_.x + way * n).norm());
  }
  place(share);
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
    let_go();
    return 0;
  }
  depth_ = faces.depth();
  force_ = by.at(depth_);
  const Vec3 pressure = TipLean::borne(guide_, faces.borne(), flat_);
  if (rubbing_.sticks())
    rubbing_.pull(faces.way(dt, pressure), n, by.stiffness, force_, faces.mobility(), dt);
  if (held_.turns()) arm_ = faces.centre() - tip_now();
  on_tissue_ = pressure + rubbing_.force();
  faces.spread(on_tissue_);
  pose_ = pose_along(pose_.tip,
                     TipLean::turned(n, pressure, -depth_, faces.across_stiffness(), by.stiffness, dt));
  return faces.power_before();
}

/// Where the tip lies, or would if it touched.
Vec3 TissueTool::tip_now() const noexcept { return hand_.x + rubbing_.lag() - depth_ * pose_.normal(); }

/// Along the normal by what the pressure does on a mode, whose forces lean with the sphere; across it by the proportions of the pressure.
TissueTool::Shapes TissueTool::find_shapes(const Touchable& body) const noexcept {
  Shapes psi;
  const Vec3 n = pose_.normal();
  const double pressed = -on_tissue_.dot(n);
  for (std::size_t i = 0; i < body.modes.size(); ++i) {
    psi[i].setZero();
    if (!(pressed > 0)) {
      for (const MassShare& share : body.contact.shares())
        psi[i] += share.share * body.modes.shape(i, share.cell);
      continue;
    }
    double load = 0;
    for (const NodalForce& nodal : forces()) {
      const Vec3 shape = body.modes.shape(i, nodal.cell);
      psi[i] -= nodal.force.dot(n) / pressed * shape;
      load += nodal.force.dot(shape);
    }
    const Vec3 across = psi[i] - psi[i].dot(n) * n;
    psi[i] = across + (across.dot(on_tissue_) - load) / pressed * n;
  }
  return psi;
}

/// Of a half space under what bears: 2 E a / (1 - nu^2) [N/m].
double TissueTool::stiffness_of_patch(const Touchable& body) const noexcept {
  const double a = std::max((held_.turns() ? smallest_of_others : smallest_of_ball) * held_.shape.size(),
                            std::sqrt(body.faces.area() / std::numbers::pi));
  return half_space_stiffness(body.moving->body(), a);
}

/// What does not follow the modes is learnt along the normal, and while it goes along that rather than across: where it slides, forces change with
/// the place.
void TissueTool::follow_compliance(const Touchable& body, const Shapes& psi, const Told& now) noexcept {
  const Vec3& n = pose_.normal();
  const double k = stiffness_of_patch(body);
  double moved = 0;
  for (std::size_t i = 0; i < body.modes.size(); ++i) moved -= psi[i].dot(n) * (now.q[i] - told_.q[i]);
  if (told_at_ > 0 && now.force > 0 && told_.force > 0 && since_told() > 0) {
    const Vec3 way = now.tip - told_.tip;
    const double in = -way.dot(n);
    if ((way + in * n).norm() <= std::abs(in))
      residual_.follow(k, now.force - told_.force, in - moved, since_told());
  } else if (now.force <= 0 || told_at_ == 0) {
    residual_.begin(k);
  }
}

/// A copy that stands must not move: told is how far modes are out from where they would rest without the tool's force, q - o with o the slow
/// part of q - psi . F / omega^2.
void TissueTool::take_offsets(const Touchable& body, const Shapes& psi, Modal& q) noexcept {
  const Vec3& force = on_tissue_;
  const double part = told_at_ > 0 ? -std::expm1(-since_told() / offset_smoothing) : 1.0;
  for (std::size_t i = 0; i < body.modes.size(); ++i) {
    const double stiffness = body.modes.omega2(i);
    const double rests = stiffness > 0 ? psi[i].dot(force) / stiffness : 0.0;
    offsets_[i] += part * (q[i] - rests - offsets_[i]);
    q[i] -= offsets_[i];
  }
}

void TissueTool::tell(TouchedTissue& tissue) noexcept {
  Touchable& body = *bodies_[touched_];
  const Vec3 n = pose_.normal();
  const Shapes psi = find_shapes(body);
  Told now;
  now.tip = tip_now();
  now.force = -on_tissue_.dot(n);
  body.modes.measure(*body.moving, now.q, now.w);
  follow_compliance(body, psi, now);
  Modal q = now.q;
  take_offsets(body, psi, q);
  const double residual = std::min(residual_.value(), most_compliance);
  const double across = std::min(across_to_along * residual, most_compliance);
  const Vec3& force = on_tissue_;

  Vec3 rest = now.tip - across * force - (residual - across) * force.dot(n) * n;
  for (std::size_t i = 0; i < body.modes.size(); ++i) rest -= q[i] * psi[i];
  if (told_at_ > 0 && now.force > 0 && told_.force > 0) {
    // What has slid has done so at once; the rest is what modes do not tell.
    const Vec3 slid = rubbing_.sticks() ? rubbing_.take_slid() : Vec3(rest - rest_);
    rest_ += slid - slid.dot(n) * n;
    rest_ -= std::expm1(-since_told() / rest_smoothing) * (rest - rest_);
  } else {
    rest_ = rest;
    rubbing_.take_slid();
  }
  // In a frame without a sample the hand stands: what changes then is learnt with the next.
  if (told_at_ == 0 || since_told() > 0) told_ = now;
  told_at_ = play_.sample();

  tissue.sample = told_at_;
  tissue.normal = array(n);
  tissue.arm = array(arm_);
  tissue.residual = residual;
  tissue.residual_across = across;
  tissue.rest = array(rest_);
  tissue.force = array(force);
  tissue.n_modes = static_cast<std::uint32_t>(body.modes.size());
  for (std::size_t i = 0; i < body.modes.size(); ++i)
    tissue.modes[i] = {array(psi[i]), body.modes.omega2(i), body.modes.damping(i), q[i], now.w[i]};
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
