#include "physics_node/contact/touch_book.h"

#include "common/message/vec3.h"

namespace palpate::physics {

void TouchBook::hand(const ToolState& state) noexcept {
  const Array4& q = state.q_WT;
  const Pose at{vec(state.p_WT), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
  Vec6 load = Vec6::Zero();
  if (state.engaged != 0) load << -vec(state.force_now), -vec(state.torque_now);
  if (seen_) {
    const double work = 0.5 * (load_ + load).dot(motion(at_, at));
    if (std::isfinite(work)) hand_work_ += work;
  }
  seen_ = true;
  at_ = at;
  load_ = load;
}

void TouchBook::frame(const Vec3& borne) noexcept {
  const double felt2 = load_.head<3>().squaredNorm(), borne2 = borne.squaredNorm();
  if (!std::isfinite(felt2 + borne2)) return;
  felt2_ += felt2;
  borne2_ += borne2;
  off2_ += (load_.head<3>() + borne).squaredNorm();
}

}  // namespace palpate::physics
