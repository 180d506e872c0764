#include "physics_node/contact/body_tool.h"

#include <cmath>
#include <numbers>

#include "common/message/vec3.h"

namespace palpate::physics {
namespace {

constexpr double patch_size = 0.2;         // [m]; a hand does not leave it before the next patch
constexpr double negligible_force = 1e-3;  // [N]

Eigen::Quaterniond quaternion(const Array4& q) { return {q[0], q[1], q[2], q[3]}; }

}  // namespace

BodyTool::BodyTool(const ToolSpec& tool, std::uint32_t index, std::size_t body, MovingBody& moving)
    : Tool(index, tool.set_point),
      body_(body),
      moving_(moving),
      handle_(moving.body()),
      low_pass_Hz_(tool.low_pass_Hz),
      stiffness_(tool.stiffness) {
  reset();
}

void BodyTool::reset() noexcept {
  from_ = to_ = {moving_.body().tip, Eigen::Quaterniond::Identity()};
  handle_.reset();
  seen_ = engaged_ = false;
  raw_ = once_ = twice_ = Wrench{};
  contacts_ = 0;
}

void BodyTool::take(const ToolState* state, double) noexcept {
  from_ = to_;
  if (state == nullptr) return;  // a silent hand holds still
  note(*state);
  engaged_ = state->engaged != 0;
  const Eigen::Quaterniond q = quaternion(state->q_WT);
  if (!seen_) {
    // The hand takes the tool where it is, wherever the device was.
    clutch_ = to_.p - vec(state->p_WT);
    clutch_q_ = q.conjugate() * to_.q;
    seen_ = true;
  }
  to_.p = vec(state->p_WT) + clutch_;
  to_.q = (q * clutch_q_).normalized();
}

HandleWork BodyTool::lead(double done, double dt) noexcept {
  const Pose now{from_.p + done * (to_.p - from_.p), from_.q.slerp(done, to_.q)};
  return handle_.lead(moving_, now, dt);
}

void BodyTool::feel(const BodyImpulse& taken, double frame_seconds) noexcept {
  raw_.force = taken.linear / frame_seconds;
  raw_.moment = taken.about(set_point_) / frame_seconds;
  contacts_ = taken.masses;
  const double part = 1 - std::exp(-2 * std::numbers::pi * low_pass_Hz_ * frame_seconds);
  once_.force += part * (raw_.force - once_.force);
  once_.moment += part * (raw_.moment - once_.moment);
  twice_.force += part * (once_.force - twice_.force);
  twice_.moment += part * (once_.moment - twice_.moment);
}

void BodyTool::write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept {
  begin_patch(patch, frame, now_ns);
  const double F = twice_.force.norm();
  if (!seen_ || F < negligible_force) return;
  patch.n_facets = 1;
  patch.contact_set = 1;
  PatchFacet& facet = patch.facets[0];
  facet = {};
  const Vec3 n = twice_.force / F;
  // In series with the hand's own spring the tissue's K_o = K leaves K / 2, which makes F at this depth.
  const Vec3 point = to_.p - clutch_ + 2 * F / stiffness_ * n;
  const Vec3 a = n.unitOrthogonal(), b = n.cross(a);
  facet.corners = {array(point + patch_size * a), array(point + patch_size * (-0.5 * a + 0.87 * b)),
                   array(point + patch_size * (-0.5 * a - 0.87 * b))};
  facet.point = array(point);
  facet.normal = array(n);
  facet.stiffness = stiffness_;
  facet.body = static_cast<std::uint32_t>(body_);
}

}  // namespace palpate::physics
