#include "physics_node/contact/tissue_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error/error.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/tip_lean.h"

namespace palpate::physics {
namespace {

// Of the shape's size: how deep a corner of the tissue may be in it before a sample of its faces is, where
// it has come from outside. Why: samples lie up to a twentieth of the size beside a corner, and in a hollow
// the shape is as steep as four to one.
constexpr double corner_before_sample = 0.2;
constexpr int looks_around = 12;           // a frame; the next one goes on
constexpr double faces_within = 1 - 1e-6;  // cosine
// Of a hand. Why: the loop gives up beyond 1.8 m/s, and few blows of a hand on tissue reach 1.
constexpr double fastest_hand = 1;  // [m/s]
constexpr double bears_more = 1.5;  // than the one that is told: then another is

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

std::vector<PressedBody> pressed(const std::vector<TouchableBody>& bodies) {
  std::vector<PressedBody> all;
  for (const TouchableBody& body : bodies) all.push_back({body.surface.get(), body.moving});
  return all;
}

/// Where the faces around look, before anything presses if the body comes back to that.
Vec3 normal_of(const LocalPlane& plane, const Body& body) noexcept {
  const bool at_rest = remembers_rest(body) && !plane.rest_normal.isZero();
  return at_rest ? plane.rest_normal : plane.normal;
}

}  // namespace

TissueTool::TissueTool(const ToolSpec& tool, std::uint32_t index, const std::vector<TouchableBody>& bodies,
                       double period, double frame, Integrator integrator, const Crew& crew)
    : PressingTool(index, tool.set_point),
      held_(held_shape(tool)),
      integrator_(integrator),
      play_(period),
      faces_(pressed(bodies), held_.shape),
      rubbing_(tool.friction) {
  const double around = (held_.turns() ? held_.half_diagonal() : 0.0) +
                        std::max(0.0, fastest_hand * frame - ToolContact::search_margin);
  for (const auto& body : bodies) {
    const Body& shape = body.moving->body();
    const double size = held_.shape.size();
    refuse_coarse(tool, size, shape);
    bodies_.push_back(std::make_unique<Touchable>(
        Touchable{body.moving, ToolContact(*body.surface, *body.moving, size, around),
                  BodyModes(shape, modes_of(shape), crew)}));
    near_.emplace_back().reserve(FacePress::most_facets);
    told_modes_ = std::max(told_modes_, static_cast<std::uint32_t>(bodies_.back()->modes.size()));
  }
  for (std::size_t b = bodies_.size(); b-- > 0;) {
    flow_.begin(bodies_[b]->moving->body());
    told_branches_ = std::max(told_branches_, static_cast<std::uint32_t>(flow_.branches().size()));
  }
}

void TissueTool::let_go() noexcept {
  force_ = 0;
  on_tissue_.setZero();
  rubbing_.release();
  faces_.release();
}

void TissueTool::reset() noexcept {
  let_go();
  play_.reset();
  engaged_ = found_ = knows_up_ = outside_ = false;
  keep_ = 1;
  told_at_ = 0;
  flow_.rest();
}

/// What was pressed flows back, unless it presses; elsewhere nothing has flowed.
void TissueTool::flow(double dt) noexcept {
  if (force_ > 0)
    pressed_at_ = tip_now();
  else if ((hand_.x - pressed_at_).norm() > held_.shape.size() + std::abs(depth_))
    flow_.rest();
  flow_.pass(force_, dt);
}

void TissueTool::take(const ToolState* state, double dt) noexcept {
  if (!may_press()) flow(frame_dt_);  // the frame before
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
void TissueTool::face(const Vec3& tip) noexcept {
  if (held_.turns()) return;
  const auto at = [&](const Vec3& up) { return faces_.way_out(tip + held_.shape.size() * up); };
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

/// Is there a facet of it near the tool?
bool TissueTool::looks(std::size_t body) const noexcept {
  return std::isfinite(bodies_[body]->nearest.distance);
}

/// Of the bodies that it presses. It stays with one until another bears clearly more.
std::size_t TissueTool::bears_most() const noexcept {
  std::size_t most = touched_;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (looks(b) && faces_.pressed(b) > (looks(most) ? bears_more * faces_.pressed(most) : 0.0)) most = b;
  return most;
}

/// Looks at all bodies, and finds the one that it is at: that bears most, or the nearest.
/// @return a point of its surface, or near it, where the tool touches it or would
std::optional<Vec3> TissueTool::look(const Vec3& tip, double t) noexcept {
  const Eigen::Matrix3d axes = held_.axes(play_.attitude(0));
  const Vec3 origin = held_.origin(tip, axes), middle = origin + axes * held_.shape.bounds().center();
  for (const auto& each : bodies_) {
    Touchable& body = *each;
    body.contact.look(held_.turns() ? middle : tip, t);
    body.nearest = held_.turns() ? body.contact.nearest_to(held_.shape, origin, axes)
                                 : ToolContact::Nearest{body.contact.nearest_distance(tip), tip, tip};
  }
  std::size_t at = touched_;
  if (force_ > 0) {
    at = bears_most();
  } else {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (bodies_[b]->nearest.distance < bodies_[at]->nearest.distance) at = b;
  }
  if (!looks(at)) return std::nullopt;
  if (at != touched_) {
    touched_ = at, told_at_ = 0;
    flow_.begin(bodies_[at]->moving->body());
  }
  if (force_ > 0 && held_.turns()) return tip + arm_;
  arm_ = bodies_[at]->nearest.on_shape - tip;
  return bodies_[at]->nearest.point;
}

/// Of all bodies that bear it the mean, weighted by what they do. @param plane  of the one that it is at
void TissueTool::find_guide(const LocalPlane& plane) noexcept {
  guide_ = normal_of(plane, bodies_[touched_]->moving->body());
  // Of what has a flat face the pressure lies across that, however flat the tissue is.
  const RigidShape::Kind kind = held_.shape.kind();
  const bool round = kind != RigidShape::Kind::box && kind != RigidShape::Kind::cylinder;
  flat_ = plane.found && round ? plane.flat : 0;
  if (!(force_ > 0 && flat_ > 0)) return;
  double pressed = faces_.pressed(touched_);
  Vec3 mean = pressed * flat_ * guide_;
  bool alone = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const double bears = b == touched_ ? 0.0 : faces_.pressed(b);
    if (!(bears > 0) || !looks(b)) continue;
    const LocalPlane other = bodies_[b]->contact.plane_under(bodies_[b]->nearest.point);
    mean += bears * (other.found ? other.flat : 0.0) * normal_of(other, bodies_[b]->moving->body());
    pressed += bears;
    alone = false;
  }
  if (alone || !(mean.norm() > 0)) return;
  flat_ = mean.norm() / pressed;
  guide_ = mean.normalized();
}

void TissueTool::find_contact(double t) noexcept {
  const bool knew_up = std::exchange(knows_up_, false), was_outside = std::exchange(outside_, false);
  found_ = false;
  hardest_ = {};
  if (!play_.seen() || bodies_.empty()) return let_go();
  hand_ = play_.at(0);
  // The tool stays in the tissue when the hand goes deeper than its spring lets it.
  const bool touched = force_ > 0;  // of whatever body
  const Vec3 tip = touched ? tip_now() : hand_.x;
  const std::optional<Vec3> under = look(tip, t);
  if (!under) return let_go();
  Touchable& body = *bodies_[touched_];
  const double way = play_.way() + 2 * held_.half_diagonal() * play_.turn();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    near_[b].clear();
    bodies_[b]->contact.facets_within(tip, faces_.reach() + way, near_[b]);
  }
  faces_.take_candidates(near_);
  const LocalPlane plane = body.contact.plane_under(*under);
  find_guide(plane);
  if (!touched) {
    if (!plane.found) return let_go();
    if (!knew_up) up_ = plane.normal;
    face(tip);
    pose_ = pose_along(hand_.x, held_.turns() ? plane.normal : up_);
  }
  found_ = knows_up_ = true;
  place(0);
  if (force_ <= 0) body.contact.find_shares(*under);
  faces_.list(pose_, way);
  if (force_ > 0) {
    outside_ = true;  // it comes from there
    return;
  }
  depth_ = faces_.depth();
  const double deepest =
      was_outside ? std::max(begins_within, corner_before_sample * held_.shape.size()) : begins_within;
  if (!std::isfinite(depth_) || (!touched && -depth_ > deepest)) let_go(), found_ = false;
  outside_ = found_ && engaged_ && (was_outside || depth_ >= 0);
}

void TissueTool::begin_step() noexcept {
  if (found_) faces_.note_motion(integrator_ == Integrator::velocity_verlet);
}

double TissueTool::press(double dt) noexcept {
  if (!found_) return 0;
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
    faces_.shift(-way);
  else
    depth_ -= way;
  force_ = 0;
  if (!engaged_ || !faces_.press(pose_, by, dt)) {
    let_go();
    flow(dt);
    return 0;
  }
  depth_ = faces_.depth();
  force_ = by.at(depth_);
  flow(dt);
  if (force_ > hardest_.force) hardest_ = {force_, flow_.staying(), tip_now()};
  const Vec3 pressure = TipLean::borne(guide_, faces_.borne(), flat_);
  if (rubbing_.sticks())
    rubbing_.pull(faces_.way(dt, pressure), n, by.stiffness, force_, faces_.mobility(), dt);
  if (held_.turns()) arm_ = faces_.centre() - tip_now();
  on_tissue_ = pressure + rubbing_.force();
  faces_.spread(on_tissue_);
  pose_ = pose_along(pose_.tip,
                     TipLean::turned(n, pressure, -depth_, faces_.across_stiffness(), by.stiffness, dt));
  return faces_.power_before();
}

/// Where the tip lies, or would if it touched.
Vec3 TissueTool::tip_now() const noexcept { return hand_.x + rubbing_.lag() - depth_ * pose_.normal(); }

}  // namespace palpate::physics
