#include "physics_node/contact/point_tool.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/message/vec3.h"
#include "common/scene/force_model.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/half_space.h"

namespace palpate::physics {
namespace {

constexpr double force_cutoff_Hz = 5.0;    // of the hand's force on its way into the tissue
constexpr double negligible_force = 1e-6;  // [N]; below this the tissue is let go
constexpr double all_moves = 0.999;        // of a force, borne by masses: hardly any scenery under the tip

/// Of cells too large for the tip the masses bear: a remark says so.
bool presses_faces(const ToolSpec& tool, const Body& body, Integrator integrator) {
  return integrator != Integrator::backward_euler && follows_shape(body.spacing(), tool.radius) &&
         asks_for_faces(tool, bears_by_faces(body));
}

}  // namespace

PointTool::PointTool(const ToolSpec& tool, std::uint32_t index, const std::vector<TouchableBody>& bodies,
                     Integrator integrator)
    : PressingTool(index, tool.set_point),
      model_(force_model_of(tool)),
      stiffness_(tool.stiffness),
      integrator_(integrator) {
  contacts_.reserve(bodies.size());
  for (const auto& body : bodies) {
    contacts_.emplace_back(*body.surface, *body.moving, tool.radius);
    moving_.push_back(body.moving);
    faces_.emplace_back();
    if (presses_faces(tool, body.moving->body(), integrator))
      faces_.back().emplace(*body.surface, *body.moving, RigidShape::sphere(tool.radius));
  }
  candidates_.reserve(FacePress::most_facets);
  pressed_shares_.reserve(most_forces);
  forces_.reserve(most_forces);
}

void PointTool::reset() noexcept {
  seen_ = engaged_ = false;
  force_.setZero();
  raw_force_.setZero();
  acted_.setZero();
  forces_.clear();
  for (auto& faces : faces_)
    if (faces) faces->release();
  pressed_shares_.clear();
  depth_ = 0;
  K_o_ = {};
  compliance_ = 0;
}

void PointTool::take(const ToolState* state, double dt) noexcept {
  frame_dt_ = dt;
  acted_ = force_;
  Vec3 target = Vec3::Zero();
  if (state != nullptr) {
    seen_ = true;
    engaged_ = state->engaged != 0;
    note(*state);
    tip_ = vec(state->p_WT);
    proxy_ = vec(state->proxy);
    if (engaged_) {
      target = vec(state->force_on_hand);
      raw_force_ = vec(state->force_now);
    }
  }
  if (state == nullptr || !engaged_) raw_force_.setZero();
  if (model_ == ForceModel::direct) return;  // computed where the tip is, in find_contact()
  if (model_ == ForceModel::raw_planes) {
    force_ = raw_force_;
    return;
  }
  // First-order low pass: F := F + (1 - e^(-2 pi f dt)) (target - F).
  force_ += low_pass_part(force_cutoff_Hz, dt) * (target - force_);
  if (target.isZero() && force_.norm() < negligible_force) force_.setZero();
}

void PointTool::compute_force(double t) noexcept {
  force_.setZero();
  proxy_ = tip_;
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  for (std::size_t b = 0; b < contacts_.size(); ++b) {
    contacts_[b].look(tip_, t);
    const double distance = contacts_[b].nearest_distance(tip_);
    if (distance < least) least = distance, nearest = b;
  }
  if (!engaged_ || !std::isfinite(least)) return;
  const LocalPlane plane = contacts_[nearest].plane_under(tip_);
  if (!plane.found) return;
  const double depth = plane.normal.dot(plane.point - tip_);
  if (depth <= 0 || depth > contacts_[nearest].reach()) return;
  const Vec3 whole = stiffness_ * depth * plane.normal;
  force_ = raw_force_ = acted_ + (whole - acted_) / (1 + stiffness_ * compliance_);
  proxy_ = tip_ + depth * plane.normal;
}

void PointTool::find_contact(double t) noexcept {
  forces_.clear();
  moving_share_ = 0;
  indentation_.setZero();
  plane_velocity_.setZero();
  if (!seen_) return;
  if (model_ == ForceModel::direct) compute_force(t);
  double least = std::numeric_limits<double>::infinity();
  const std::size_t before = touched_;
  for (std::size_t b = 0; b < contacts_.size(); ++b) {
    contacts_[b].look(proxy_, t);
    const double distance = contacts_[b].nearest_distance(proxy_);
    if (distance < least) least = distance, touched_ = b;
  }
  if (!std::isfinite(least)) return;

  if (touched_ != before) {
    if (faces_[before]) faces_[before]->release();
    pressed_shares_.clear();
  }
  if (pressed_by_faces()) find_faces();
  if (pressed_shares_.empty()) contacts_[touched_].find_shares(proxy_);
  for (const MassShare& share : shares()) {
    moving_share_ += share.share;
    plane_velocity_ += share.share * moving_[touched_]->velocity(share.cell);
    indentation_ += share.share * moving_[touched_]->displacement(share.cell);
    if (!force_.isZero()) forces_.push_back({share.cell, -share.share * force_});
  }
  if (pressed_by_faces() && !pressed_shares_.empty() && moving_share_ > all_moves &&
      remembers_rest(moving_[touched_]->body()))
    indentation_ = -depth_ * pose_.normal();
  follow_stiffness();
  find_compliance();
}

std::span<const MassShare> PointTool::shares() const noexcept {
  if (!pressed_shares_.empty()) return pressed_shares_;
  return contacts_[touched_].shares();
}

void PointTool::find_faces() noexcept {
  ToolContact& contact = contacts_[touched_];
  FacePress& faces = *faces_[touched_];
  if (force_.isZero()) faces.release(), pressed_shares_.clear();
  const LocalPlane plane = contact.plane_under(proxy_);
  if (!plane.found) return;
  const bool at_rest = remembers_rest(moving_[touched_]->body()) && !plane.rest_normal.isZero();
  pose_ = pose_along(proxy_, at_rest ? plane.rest_normal : plane.normal);
  depth_ = pressed_shares_.empty() ? 0 : faces.depth() + (plane.rest - proxy_).dot(pose_.normal());
  if (force_.isZero()) return;
  candidates_.clear();
  contact.facets_within(proxy_, faces.reach(), candidates_);
  faces.list(pose_, candidates_);
}

void PointTool::begin_step() noexcept {
  if (pressed_by_faces() && !force_.isZero())
    faces_[touched_]->note_motion(integrator_ == Integrator::velocity_verlet);
}

double PointTool::press(double dt) noexcept {
  FacePress& faces = *faces_[touched_];
  const double pressing = force_.dot(pose_.normal());
  forces_.clear();
  pressed_shares_.clear();
  if (force_.isZero() || !faces.press(pose_, pressing, dt)) return 0;
  faces.spread(-force_);
  for (const NodalForce& nodal : faces.forces()) {
    forces_.push_back(nodal);
    pressed_shares_.push_back({nodal.cell, -nodal.force.dot(force_) / force_.squaredNorm()});
  }
  return faces.power_before();
}

void PointTool::find_compliance() noexcept {
  compliance_ = 0;
  if (integrator_ != Integrator::backward_euler || moving_share_ <= 0) return;
  double w = 0;  // [1/kg]
  for (const MassShare& share : shares())
    w += share.share * share.share *
         moving_[touched_]->body().inverse_mass[static_cast<std::size_t>(share.cell)];
  const double square = moving_share_ * moving_share_;
  compliance_ = 1 / (K_o_.value() / square + 1 / (w * frame_dt_ * frame_dt_));
}

void PointTool::follow_stiffness() noexcept {
  const double F_n = acted_.norm();
  if (!K_o_.begun() || F_n <= negligible_force) {
    K_o_.begin(half_space_stiffness(moving_[touched_]->body(), 0.5 * contacts_[touched_].reach()));
    return;
  }
  if (moving_share_ > 0)
    K_o_.follow(moving_share_ * F_n, -indentation_.dot(acted_) / F_n / moving_share_, frame_dt_);
}

void PointTool::write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept {
  begin_patch(patch, frame, now_ns);
  if (!seen_ || contacts_.empty()) return;
  ToolContact& contact = contacts_[touched_];
  const bool at_rest = remembers_rest(moving_[touched_]->body());
  patch.n_facets = contact.write_facets(proxy_, static_cast<std::uint32_t>(touched_), patch.facets.data(),
                                        max_patch_facets, at_rest && model_ == ForceModel::norton);
  patch.contact_set = contact.contact_set();
  // What lies on scenery does not give: masses with a share s of the force F move by s F / K_o, the point by s times that.
  const double s = moving_share_;
  const double K_o = s > 0 ? std::min(K_o_.value() / (s * s), rigid_stiffness) : rigid_stiffness;
  for (std::uint32_t f = 0; f < patch.n_facets; ++f) {
    PatchFacet& facet = patch.facets[f];
    if (model_ != ForceModel::norton) {
      facet.stiffness = rigid_stiffness;
      continue;
    }
    const Vec3 n = vec(facet.normal);
    if (!at_rest) facet.point = array(vec(facet.point) + std::max(0.0, force_.dot(n)) / K_o * n);
    facet.stiffness = K_o;
    facet.velocity = array(plane_velocity_);
  }
}

}  // namespace palpate::physics
