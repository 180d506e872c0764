// Rows of the coupling that feels a copy of tissue, on the product's own finite elements: what is told are modes of a body near rest, and
// the body is pressed a tenth of its height.

#include <fmt/format.h>

#include <algorithm>

#include "bench/haptic/ratio_off.h"
#include "bench/haptic/rows_touch.h"

namespace palpate::bench {
namespace {

constexpr int all_told = 9;

Case elements_case(const LinkAge& age, int modes) {
  Case c = led_case(solid_block, age);
  c.told.modes = modes;
  return c;
}

}  // namespace

Row sines_on_elements_are_felt_as_borne(Runs& runs) {
  RatioOff felt, borne;
  for (const LinkAge& age : link_ages)
    for (const double frequency : touch_frequencies(runs.effort)) {
      const SineResult r = feel_sine(elements_case(age, all_told), frequency);
      felt.add(r.felt_by_borne);
      borne.add(r.borne_by_ideal);
      runs.sines.push_back({solid_block.name, age.name, frequency, r});
    }
  return {"T1", "the same on a block of the product's elements (15 kPa, a tenth of its height deep)",
          "felt / borne within 2 %, 3 deg; borne / ideal within 5 %, 5 deg",
          fmt::format("felt off by {}; borne by {}", felt.text(), borne.text()),
          felt.within(0.02, 3) && borne.within(0.05, 5)};
}

Row one_mode_of_elements_is_seen_through(Runs&) {
  RatioOff one, nine;
  for (const double frequency : {10.0, 20.0}) {
    one.add(feel_sine(elements_case(link_ages[2], 1), frequency).felt_by_borne);
    nine.add(feel_sine(elements_case(link_ages[2], all_told), frequency).felt_by_borne);
  }
  return {"T1",
          "negative control: the block told by the mode that the contact feels most, 10 and 20 Hz at 100 ms",
          "felt / borne off by more than 2 % or 3 deg; nine within",
          fmt::format("one mode off by {}; nine by {}", one.text(), nine.text()),
          !one.within(0.02, 3) && nine.within(0.02, 3)};
}

Row taps_on_elements_are_felt_as_borne(Runs&) {
  double peak = 0, impulse = 0, surplus = 0;
  for (const LinkAge& age : link_ages) {
    const TouchRun run = tap(elements_case(age, all_told), 0.1, 3e-3);
    peak = std::max(peak, felt_off(run, peak_of));
    impulse = std::max(impulse, felt_off(run, impulse_of));
    surplus = std::max(surplus, run.surplus);
  }
  return {"T2", "a tap of 0.1 s, 2 mm deep, from 3 mm above, on the block of elements, all ages",
          "felt / borne: peak within 5 %, impulse within 2 %; G <= 0.1 mJ",
          fmt::format("peak off by {:.2f} %, impulse by {:.2f} %; G {:.3f} mJ", 100 * peak, 100 * impulse,
                      1e3 * surplus),
          peak <= 0.05 && impulse <= 0.02 && surplus <= EnergyBook::G_allowed};
}

}  // namespace palpate::bench
