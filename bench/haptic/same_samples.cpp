#include "bench/haptic/same_samples.h"

#include "bench/haptic/world_cases.h"
#include "physics_node/contact/tissue_tool.h"

namespace palpate::bench {

Case slab_case(const SlabModel& slab, const LinkAge& age) {
  Case c = case_of(slab);
  c.rate_Hz = age.rate_Hz;
  c.link.delay = age.delay;
  c.link.loss = age.loss;
  return c;
}

double time_of(std::uint64_t sample) noexcept {
  return (static_cast<double>(sample) - 1) * PressedTissue::sample_time - Trial::lead_in;
}

SameSamples follow(Case c, const Path& path, double from, double until) {
  c.feels = ForceModel::tissue;
  Trial trial(c, path);
  trial.kinematic = true;
  SameSamples same;
  trial.run(until, [&] {
    const haptic::PointTouch& touch = *trial.controller().tissue();
    if (trial.t() < from) return;
    same.felt[touch.history().newest()] = touch.felt();
    const auto& tool = dynamic_cast<const physics::TissueTool&>(trial.world()->world().tool(0));
    same.borne[tool.sample()] = tool.borne();
  });
  same.step = trial.force_step_beyond_motion();
  same.surplus = trial.energy().surplus();
  return same;
}

}  // namespace palpate::bench
