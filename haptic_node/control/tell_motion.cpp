#include "haptic_node/control/tell_motion.h"

#include "common/message/vec3.h"

namespace palpate::haptic {

void tell_motion(const Controller& controller, ToolState& state) noexcept {
  const PointTouch* touch = controller.tissue();
  if (touch == nullptr || touch->history().newest() == 0) return;
  const TipHistory& tips = touch->history();
  const Vec3 newest = tips.at(tips.newest()).x;
  state.sample = tips.newest();
  state.p_WT = array(newest);
  state.force_now = array(touch->felt());
  state.stiffness = touch->gain() * controller.settings().stiffness;
  state.damping = touch->gain() * controller.settings().damping;
  state.force_limit = controller.force_limit();
  state.n_before = 0;
  for (std::uint64_t back = 1; back <= max_told_samples && tips.has(tips.newest() - back); ++back) {
    const Vec3 from = tips.at(tips.newest() - back).x - newest;
    state.before[state.n_before++] = {static_cast<float>(from.x()), static_cast<float>(from.y()),
                                      static_cast<float>(from.z())};
  }
}

}  // namespace palpate::haptic
