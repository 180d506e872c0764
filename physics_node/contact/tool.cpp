#include "physics_node/contact/tool.h"

#include "common/message/vec3.h"

namespace palpate::physics {

void Tool::note(const ToolState& state) noexcept {
  // Why: of a longer way nobody knows what was felt on it. Another hand, or that of another day, has other ticks and stamps.
  constexpr double one_way_ns = 1e9;
  const double since_ns = static_cast<double>(state.stamp_ns) - static_cast<double>(stamp_ns_);
  if (state.tick < tick_ || since_ns < 0 || since_ns > one_way_ns) book_.lose_hand();
  tick_ = state.tick;
  stamp_ns_ = state.stamp_ns;
  p_WT_ = state.p_WT;
  q_WT_ = state.q_WT;
  book_.hand(state);
}

void Tool::begin_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) const noexcept {
  patch.tool = index_;
  patch.tick = frame;
  patch.stamp_ns = now_ns;
  patch.answers = tick_;
  patch.answers_ns = stamp_ns_;
  patch.n_facets = patch.n_tissues = 0;
  patch.contact_set = 0;
}

void Tool::begin_wrench(ToolWrench& out, const Wrench& now, std::uint64_t frame, std::int64_t now_ns,
                        double t) const noexcept {
  out.tool = index_;
  out.tick = frame;
  out.stamp_ns = now_ns;
  out.answers = tick_;
  out.answers_ns = stamp_ns_;
  out.t = t;
  out.p_WT = p_WT_;
  out.q_WT = q_WT_;
  out.tip = array(tip());
  out.stiffness = {};
  out.normal = {};
  out.stretch = 0;
  out.force = array(now.force);
  out.moment = array(now.moment);
  out.set_point = array(set_point_);
  out.n_contacts = contacts();
}

}  // namespace palpate::physics
