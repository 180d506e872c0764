#include "bench/haptic/world_cases.h"

#include <fmt/format.h>

namespace palpate::bench {

Case case_of(const SlabModel& slab) {
  Case c;
  c.slab = &slab;
  c.object = {slab.name, 1.0, 0.0, slab.about};
  c.hand = hand_springs[1];
  c.stiffness = 500;
  return c;
}

std::vector<Case> world_cases(Effort effort, RenderMode mode, const DeviceModel& device) {
  std::vector<Case> bases;
  for (const SlabModel& slab : slab_models)
    for (const HandSpring& hand : holding_hands) {
      Case c = case_of(slab);
      c.device = device;
      c.hand = hand;
      c.mode = mode;
      bases.push_back(c);
    }
  MatrixSize size;
  size.losses = {0, 0.1};
  if (effort == Effort::quick) size = {{60, 1000}, {5e-3, 50e-3}, {0.1}, {}};
  return chosen(over_links(bases, size), effort, 12);
}

std::string world_figure(const Tally& t) {
  return fmt::format(
      "{} cases: {} above 200 um, {} above 100 um, {} break an energy bound, {} not felt; most {:.0f} um, G "
      "{:.3f} "
      "mJ; step {:.3f} N, {:.3f} N beyond K v T",
      t.cases, t.above_200_um, t.above_100_um, t.energy_broken, t.unfelt, 1e6 * t.swing_most,
      1e3 * t.surplus_most, t.force_step_most, t.step_beyond_most);
}

}  // namespace palpate::bench
