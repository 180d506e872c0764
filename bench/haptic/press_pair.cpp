#include "bench/haptic/press_pair.h"

#include <algorithm>

namespace palpate::bench {

std::vector<PressSample> press_with_60_grams(RenderMode mode) {
  Case c;
  c.device = {"handle", 0.06, 0.3, 0.0, 0.0, 20.0};
  c.hand = hand_springs[3];
  c.object = object_models[0];
  c.rate_Hz = 50;
  c.stiffness = 600;
  c.mode = mode;
  Trial trial(c, [](double) { return Aim{{0, 0, 1e-3}, Vec3::Zero()}; });
  trial.run(0);
  trial.push = {0, 0, -1};
  std::vector<PressSample> samples;
  trial.run(4.0, [&] { samples.push_back({trial.t(), trial.rendered().force.z(), trial.plant().x().z()}); });
  return samples;
}

double force_range(const std::vector<PressSample>& samples, double since) {
  double low = 1e9, high = -1e9;
  for (const PressSample& s : samples) {
    if (s.t < since) continue;
    low = std::min(low, s.force);
    high = std::max(high, s.force);
  }
  return high - low;
}

}  // namespace palpate::bench
