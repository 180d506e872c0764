#include "physics_node/contact/body_tool.h"

#include "common/message/vec3.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

Eigen::Quaterniond quaternion(const Array4& q) { return {q[0], q[1], q[2], q[3]}; }

}  // namespace

BodyTool::BodyTool(const ToolSpec& tool, std::uint32_t index, std::size_t body, NodeMotion& moving)
    : LedTool(index, tool.set_point),
      body_(body),
      moving_(moving),
      handle_(moving.body()),
      low_pass_Hz_(tool.low_pass_Hz),
      tangent_(tool.low_pass_Hz, 0.5 * tool.stiffness) {
  reset();
}

void BodyTool::reset() noexcept {
  from_ = to_ = {moving_.body().tip, Eigen::Quaterniond::Identity()};
  handle_.reset();
  seen_ = engaged_ = false;
  raw_ = {};
  felt_ = {};
  tangent_.reset();
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

LeadWork BodyTool::lead(double done, double dt) noexcept {
  const Pose now{from_.p + done * (to_.p - from_.p), from_.q.slerp(done, to_.q)};
  return {handle_.lead(moving_, now, dt).work, 0};
}

void BodyTool::end_frame(Collisions* collisions, double frame_seconds) noexcept {
  const BodyImpulse taken = collisions != nullptr ? collisions->take_impulse(body_) : BodyImpulse{};
  raw_.force = taken.linear / frame_seconds;
  raw_.moment = taken.about(set_point_) / frame_seconds;
  contacts_ = taken.masses;
  felt_.pass(raw_, low_pass_part(low_pass_Hz_, frame_seconds));
  tangent_.frame(taken.sum_about(to_.p), motion(from_, to_), frame_seconds);
}

void BodyTool::write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept {
  begin_patch(patch, frame, now_ns);
}

void BodyTool::write_wrench(ToolWrench& out, std::uint64_t frame, std::int64_t now_ns,
                            double t) const noexcept {
  begin_wrench(out, felt_by(tangent_), frame, now_ns, t);
  Eigen::Map<Mat6>(out.stiffness.data()) = tangent_.stiffness();  // symmetric
}

}  // namespace palpate::physics
