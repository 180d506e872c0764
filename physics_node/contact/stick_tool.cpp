#include "physics_node/contact/stick_tool.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/message/vec3.h"
#include "common/scene/force_model.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

constexpr double patch_half = 0.020;  // side of the plane's square about the tip [m]

/// Stiffness of what a hand feels through a spring K that only ways stretch: K_t - K_t E (K + E^T K_t E)^-1 E^T K_t.
Mat6 through_spring(const Mat6& K_t, double K) noexcept {
  const Eigen::Matrix3d both = K_t.topLeftCorner<3, 3>() + K * Eigen::Matrix3d::Identity();
  const Eigen::Matrix<double, 6, 3> ways = K_t.leftCols<3>();
  return K_t - ways * both.ldlt().solve(ways.transpose());
}

}  // namespace

StickTool::StickTool(const ToolSpec& tool, std::uint32_t index, const BodyModels& bodies,
                     const std::vector<TouchableBody>& surfaces)
    : LedTool(index, tool.set_point),
      length_(tool.length),
      radius_(tool.radius),
      attitude_(tool.attitude),
      low_pass_Hz_(tool.low_pass_Hz),
      hand_spring_(force_model_of(tool) == ForceModel::direct ? std::numeric_limits<double>::infinity()
                                                              : tool.stiffness),
      surface_(surfaces, radius_),
      tangent_(tool.low_pass_Hz, 0.5 * tool.stiffness) {
  for (const auto& body : bodies) {
    Near near;
    near.moving = body.get();
    const auto most = static_cast<std::size_t>(body->body().n_nodes());
    near.all.resize(most);
    std::iota(near.all.begin(), near.all.end(), 0U);
    near.cell.resize(most);
    near.mass.resize(most);
    for (auto* array : {&near.rest, &near.x, &near.v, &near.v_move}) array->assign(most, Vec3::Zero());
    near_.push_back(std::move(near));
    faces_.emplace_back(*surfaces[near_.size() - 1].surface, *body, radius_);
  }
}

void StickTool::reset() noexcept {
  seen_ = false;
  n_near_ = contacts_ = 0;
  search_.reset();
  sum_ = {};
  raw_ = {};
  felt_ = {};
  tangent_.reset();
  surface_.reset();
}

Stick StickTool::stick_at(const Pose& pose) const noexcept {
  return {pose.p, -length_ * (pose.q * attitude_ * Vec3::UnitZ()), radius_};
}

void StickTool::take(const ToolState* state, double) noexcept {
  from_ = to_;
  done_ = 0;
  if (state == nullptr) return;  // a silent hand holds still
  note(*state);
  to_ = {vec(std::isinf(hand_spring_) ? state->p_WT : state->proxy),
         Eigen::Quaterniond(state->q_WT[0], state->q_WT[1], state->q_WT[2], state->q_WT[3])};
  if (!seen_) from_ = to_;
  seen_ = true;
}

void StickTool::list(Near& near) noexcept {
  const Stick stick = stick_at(to_);
  const double reach = radius_ + 2 * StickSearch::margin;
  const Body& body = near.moving->body();
  near.n = 0;
  for (const Index cell : body.nodes()) {
    if (body.inverse_mass[static_cast<std::size_t>(cell)] == 0) continue;
    const Vec3 x = near.moving->position(cell);
    if ((x - stick.axis_point(stick.nearest(x))).squaredNorm() > reach * reach) continue;
    if (near.n == near.cell.size()) return;
    near.cell[near.n] = cell;
    near.rest[near.n] = body.rest_position(cell);
    near.mass[near.n] = node_mass(body, cell);
    ++near.n;
  }
}

void StickTool::find_contact(double t) noexcept {
  if (!seen_) return;
  const Stick now = stick_at(to_);
  surface_.look(now, t);
  const double reach = radius_ + 2 * StickSearch::margin;
  const bool changed = std::any_of(faces_.begin(), faces_.end(),
                                   [&](const StickFaces& faces) { return faces.has_changed(now, reach); });
  if (!search_.due(now, t) && !changed) return;
  n_near_ = 0;
  for (Near& near : near_) {
    list(near);
    n_near_ += near.n;
  }
  for (StickFaces& faces : faces_) {
    faces.list(now, reach);
    n_near_ += faces.size();
  }
}

LeadWork StickTool::lead_body(Near& near, const Stick& before, const Stick& now, double dt) noexcept {
  LeadWork sum;
  near.moving->read({near.all.data(), near.n}, near.cell, near.rest, dt, near.x, near.v, near.v_move);
  for (std::size_t i = 0; i < near.n; ++i) {
    const StickHit hit = sweep(before, now, near.x[i], near.x[i] + dt * near.v_move[i]);
    if (!hit.hit) continue;
    const Vec3& n = hit.normal;
    const double v_s = n.dot(hit.axis_motion) / dt;
    const double depth =
        std::min(hit.depth, dt * (exit_speed + hit.axis_motion.norm() / dt + near.v_move[i].norm()));
    const double dv = depth / dt, m = near.mass[i];
    const bool carried =
        (near.x[i] - before.axis_point(before.nearest(near.x[i]))).norm() < radius_ + carried_within;
    near.pushes.add(*near.moving, {near.cell[i], dv * n}, dt);
    const double J = m * dv, given = J * (n.dot(near.v[i]) + 0.5 * dv);
    // A mass that is carried takes all that the hand gives; one that is struck leaves a part.
    sum.work += carried ? given : J * v_s;
    sum.lost += carried ? 0 : J * v_s - given;
    const Vec3 at = near.x[i] + dt * (near.v_move[i] + dv * n);
    sum_.add(-m * dv * n, at - to_.p);
    ++contacts_;
  }
  near.pushes.give(*near.moving, dt);
  return sum;
}

LeadWork StickTool::lead(double done, double dt) noexcept {
  LeadWork sum;
  const Stick before = stick_at(pose_at(done_)), now = stick_at(pose_at(done));
  done_ = done;
  contacts_ = 0;
  if (n_near_ == 0) return sum;
  for (Near& near : near_) {
    if (near.n == 0) continue;
    const LeadWork one = lead_body(near, before, now, dt);
    sum.work += one.work;
    sum.lost += one.lost;
  }
  for (StickFaces& faces : faces_) {
    const LeadWork one = faces.lead(before, now, to_.p, dt, sum_, contacts_);
    sum.work += one.work;
    sum.lost += one.lost;
  }
  return sum;
}

void StickTool::end_frame(Collisions*, double frame_seconds) noexcept {
  raw_.force = sum_.impulse.head<3>() / frame_seconds;
  raw_.moment = sum_.impulse.tail<3>() / frame_seconds + (to_.p - set_point_).cross(raw_.force);
  felt_.pass(raw_, low_pass_part(low_pass_Hz_, frame_seconds));
  const bool pressed = spring() != nullptr && spring()->gap < 0;
  tangent_.frame(sum_, motion(from_, to_), frame_seconds, pressed ? surface_.learnt_stiffness() : 0.0);
  sum_ = {};
  if (!seen_ || std::isinf(hand_spring_)) return;
  Vec6 felt;
  const Vec3 force = felt_.value().force;
  felt << force, felt_.value().moment + (set_point_ - to_.p).cross(force);
  surface_.follow(stick_at(to_), felt, frame_seconds);
}

void StickTool::write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept {
  begin_patch(patch, frame, now_ns);
  const NortonSpring* plane = spring();
  if (plane == nullptr) return;
  const Vec3 n = plane->normal, u = n.unitOrthogonal(), v = n.cross(u);
  const Vec3 foot = to_.p - plane->gap * n;
  const auto corner = [&](double a, double b) { return array(foot + patch_half * (a * u + b * v)); };
  patch.n_facets = 2;
  patch.contact_set = surface_.body() + 1;
  patch.facets[0].corners = {corner(-1, -1), corner(1, -1), corner(1, 1)};
  patch.facets[1].corners = {corner(-1, -1), corner(1, 1), corner(-1, 1)};
  for (std::size_t f = 0; f < 2; ++f) {
    PatchFacet& facet = patch.facets[f];
    facet.point = array(foot);
    facet.normal = array(n);
    facet.stiffness = plane->stiffness;
    facet.body = static_cast<std::uint32_t>(surface_.body());
  }
}

void StickTool::write_wrench(ToolWrench& out, std::uint64_t frame, std::int64_t now_ns,
                             double t) const noexcept {
  const Wrench now = felt_by(tangent_);
  begin_wrench(out, now, frame, now_ns, t);
  const double K = hand_spring_;
  if (std::isfinite(K)) out.p_WT = array(to_.p - now.force / K);
  const NortonSpring* surface = spring();
  const Mat6 K_t = surface != nullptr ? surface->tangent() : tangent_.stiffness();
  Eigen::Map<Mat6>(out.stiffness.data()) = std::isfinite(K) ? through_spring(K_t, K) : K_t;  // symmetric
  if (surface == nullptr) return;
  out.normal = array(surface->normal);
  out.stretch = surface->normal.dot(to_.p - vec(out.p_WT)) - surface->gap;
}

}  // namespace palpate::physics
