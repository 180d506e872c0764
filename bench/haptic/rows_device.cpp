#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/haptic/rows.h"
#include "haptic_node/device/haptic_device.h"

namespace palpate::bench {
namespace {

using haptic::DeviceSample;
using haptic::HapticState;

constexpr double trouble_at = 2.0;  // the trouble begins [s]

struct Trouble {
  const char* name;
  std::function<void(DeviceSample&, int tick)> spoil;  // tick 0 is the first one in trouble
  HapticState becomes;
  int within;  // ticks until that state [ms]
  int silent;  // ticks until 0 N for good; -1: forces go on
};

void has_nothing_new(DeviceSample& sample, int since) {
  sample.has_new = false;
  sample.t_ns -= since * Trial::tick_ns;
}

std::vector<Trouble> troubles() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {
      {"one NaN", [](DeviceSample& s, int i) { s.x.z() = i == 0 ? nan : s.x.z(); }, HapticState::run, 0, -1},
      {"NaN", [](DeviceSample& s, int) { s.x.x() = nan; }, HapticState::fault, 3, 3},
      {"5 mm jump, once", [](DeviceSample& s, int i) { s.x.z() += i == 0 ? -5e-3 : 0; }, HapticState::run, 0,
       -1},
      {"5 mm jump, for good", [](DeviceSample& s, int) { s.x.z() -= 5e-3; }, HapticState::fault, 3, 3},
      {"frozen", [](DeviceSample& s, int i) { has_nothing_new(s, i + 1); }, HapticState::safe, 21, 42},
      {"4 ms of nothing new, again and again",
       [](DeviceSample& s, int i) {
         if (i % 10 < 4) has_nothing_new(s, i % 10 + 1);
       },
       HapticState::run, 0, -1},
      {"1.8 m/s", [](DeviceSample& s, int i) { s.x.x() += 1.8e-3 * i; }, HapticState::safe, 20, 40},
      {"overspeed bit", [](DeviceSample& s, int) { s.fault = HDEV_FAULT_OVERSPEED; }, HapticState::fault, 1,
       1},
      {"unplugged", [](DeviceSample& s, int) { s.lost = true; }, HapticState::fault, 1, 1},
      {"let go", [](DeviceSample& s, int) { s.held = false; }, HapticState::safe, 1, 21},
  };
}

/// @return what is wrong, or nothing
std::string complaint(const Trouble& trouble, double& rise) {
  Case c;
  c.object = object_models[0];
  c.hand = hand_springs[1];
  Trial trial(c, press_path(c));
  trial.run(trouble_at);
  int i = 0, reached = -1, last_force = -1;
  bool finite = true;
  const double before = trial.rendered().force.norm();
  trial.spoil_sample = [&](DeviceSample& sample) { trouble.spoil(sample, i); };
  trial.run(trouble_at + 0.2, [&] {
    ++i;
    const double f = trial.rendered().force.norm();
    finite = finite && std::isfinite(f);
    rise = std::max(rise, f - before);
    if (f > 0) last_force = i;
    if (reached < 0 && trial.controller().state() == trouble.becomes) reached = i;
  });
  if (!finite) return fmt::format("{}: force is not finite", trouble.name);
  if (reached < 0 || (trouble.within > 0 && reached > trouble.within))
    return fmt::format("{}: {} after {} ms", trouble.name, name_of(trial.controller().state()), reached);
  if (trouble.silent < 0)
    return last_force == i ? std::string() : fmt::format("{}: force ends", trouble.name);
  return last_force < trouble.silent ? std::string()
                                     : fmt::format("{}: force until {} ms", trouble.name, last_force);
}

}  // namespace

Row bad_devices_are_stopped() {
  std::string wrong;
  double rise = 0;
  const std::vector<Trouble> all = troubles();
  for (const Trouble& trouble : all) {
    const std::string text = complaint(trouble, rise);
    if (!text.empty()) wrong += (wrong.empty() ? "" : "; ") + text;
  }
  return {
      "F5", "NaN, jumps, frozen or missing samples, 1.8 m/s, fault bits, unplugged, let go, each in contact",
      "run, safe or fault as stated, 0 N within 20 ms of safe and 1 ms of fault; force never rises by 0.1 N",
      wrong.empty() ? fmt::format("{} kinds as stated; rise {:.3f} N", all.size(), rise) : wrong,
      wrong.empty() && rise < 0.1};
}

}  // namespace palpate::bench
