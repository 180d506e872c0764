// Rows of the coupling that feels a copy of tissue, on a led hand: what is felt, borne and ideal.

#include "bench/haptic/rows_touch.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/haptic/ratio_off.h"

namespace palpate::bench {
namespace {

std::vector<const SpecimenModel*> linear_specimens() {
  static const SpecimenModel O1 = specimen_of(object_models[1]), O2 = specimen_of(object_models[2]),
                             O3 = specimen_of(object_models[3]);
  return {&O1, &O2, &O3, &chain_of_ten, &relaxing_solid};
}

}  // namespace

std::vector<double> touch_frequencies(Effort effort) {
  if (effort == Effort::quick) return {1, 10, 20};
  return {0.5, 1, 2, 5, 10, 20};
}

Row sines_are_felt_as_borne(Runs& runs) {
  RatioOff felt, borne, motor, ball;
  double made = 0;
  for (const SpecimenModel* specimen : linear_specimens())
    for (const LinkAge& age : link_ages)
      for (const double frequency : touch_frequencies(runs.effort)) {
        const SineResult r = feel_sine(led_case(*specimen, age), frequency);
        felt.add(r.felt_by_borne);
        borne.add(r.borne_by_ideal);
        motor.add(r.motor_by_borne);
        made = std::max(made, r.made);
        runs.sines.push_back({specimen->name, age.name, frequency, r});
      }
  for (const LinkAge& age : link_ages)
    for (const double frequency : touch_frequencies(runs.effort)) {
      const SineResult r = feel_sine(led_case(hertz_ball, age), frequency);
      ball.add(r.felt_by_borne);
      runs.sines.push_back({hertz_ball.name, age.name, frequency, r});
    }
  return {
      "T1",
      "copy of tissue: sine of 0.5 mm about 2 mm, 0.5 to 20 Hz, ages of 2, 20 and 100 ms; O1 to O3, chain of "
      "ten, "
      "standard linear solid",
      "felt / borne within 2 %, 3 deg; borne / ideal within 5 %, 5 deg",
      fmt::format(
          "felt off by {}; borne by {}. At the motor {}; Hertz, told by its tangent, {} (no limit); the copy "
          "made {:.4f} mJ by itself",
          felt.text(), borne.text(), motor.text(), ball.text(), 1e3 * made),
      felt.within(0.02, 3) && borne.within(0.05, 5)};
}

/// A copy that is one lump cannot be a chain that waves run through: the row must see that.
Row lump_of_a_chain_is_seen_through(Runs&) {
  Case c = led_case(chain_of_ten, link_ages[1]);
  c.told.modes = 1;
  RatioOff one, three;
  for (const double frequency : {5.0, 10.0, 20.0}) {
    one.add(feel_sine(c, frequency).felt_by_borne);
    three.add(feel_sine(led_case(chain_of_ten, link_ages[1]), frequency).felt_by_borne);
  }
  return {"T1", "negative control: the chain told by its lowest mode alone, 5 to 20 Hz",
          "felt / borne off by more than 2 % or 3 deg; three modes within",
          fmt::format("one mode off by {}; three by {}", one.text(), three.text()),
          !one.within(0.02, 3) && three.within(0.02, 3)};
}

Row taps_are_felt_as_borne(Runs&) {
  double peak = 0, impulse = 0, surplus = 0, ball_peak = 0, ball_impulse = 0;
  for (const LinkAge& age : link_ages)
    for (const auto& [time, clear] : {std::pair{0.1, 0.2e-3}, std::pair{0.1, 3e-3}}) {
      for (const SpecimenModel* specimen : linear_specimens()) {
        const TouchRun run = tap(led_case(*specimen, age), time, clear);
        peak = std::max(peak, felt_off(run, peak_of));
        impulse = std::max(impulse, felt_off(run, impulse_of));
        surplus = std::max(surplus, run.surplus);
      }
      const TouchRun run = tap(led_case(hertz_ball, age), time, clear);
      ball_peak = std::max(ball_peak, felt_off(run, peak_of));
      ball_impulse = std::max(ball_impulse, felt_off(run, impulse_of));
    }
  return {"T2", "a tap of 0.1 s, 2 mm deep, from 0.2 and 3 mm above, all ages",
          "felt / borne: peak within 2 %, impulse within 1 %; G <= 0.1 mJ",
          fmt::format(
              "peak off by {:.2f} %, impulse by {:.2f} %; G {:.3f} mJ. Hertz {:.1f} %, {:.1f} % (no limit)",
              100 * peak, 100 * impulse, 1e3 * surplus, 100 * ball_peak, 100 * ball_impulse),
          peak <= 0.02 && impulse <= 0.01 && surplus <= EnergyBook::G_allowed};
}

Row relaxation_is_felt(Runs&) {
  double told = 0, untold = 0;
  for (const SpecimenModel* solid : {&relaxing_solid, &slow_solid})
    for (const LinkAge& age : link_ages) {
      Case c = led_case(*solid, age);
      told = std::max(told, relaxation_error(c));
      c.told.tells_branches = false;
      untold = std::max(untold, relaxation_error(c));
    }
  return {"T3", "2 mm pressed in 20 ms and held; solids that relax to half in 0.1 and 1 s, all ages",
          "rms of felt less ideal within 2 % where the branch is told, 8 % where it is not",
          fmt::format("{:.2f} % told, {:.1f} % not told", 100 * told, 100 * untold),
          told <= 0.02 && untold <= 0.08};
}

/// Samples below 3 mm above rest are the tap's own: tissue that springs back may touch the tip again on its way.
Row clear_tip_bears_nothing(Runs&) {
  double borne = 0, felt = 0, today = 0;
  int samples = 0;
  for (const SpecimenModel* specimen : linear_specimens())
    for (const LinkAge& age : link_ages) {
      const TouchRun run = tap(led_case(*specimen, age), 0.2, 10e-3);
      for (const Touched& s : run.samples) {
        if (s.x > -3e-3) continue;
        ++samples;
        borne = std::max(borne, s.borne);
        felt = std::max(felt, s.felt);
      }
    }
  const TouchRun run = tap(todays_case(object_models[1], link_ages[1]), 0.2, 10e-3);
  for (const Touched& s : run.samples)
    if (s.x <= -3e-3) today = std::max(today, s.borne);
  return {"T4", "a tap from 10 mm above: samples of a tip that is 3 mm clear",
          "0 N borne and felt in every one; negative control: today's coupling bears more than 0",
          fmt::format("{} samples: borne {:g} N, felt {:g} N; today's {:.3f} N", samples, borne, felt, today),
          samples > 1000 && borne == 0 && felt == 0 && today > 0.01};
}

Row cuts_are_felt(Runs&) {
  std::string figure;
  bool pass = true;
  for (const LinkAge& age :
       {link_ages[0], link_ages[1], link_ages[2], LinkAge{"100 ms, 1 kHz", 0.1, 1000, 50e-3, 0.1}}) {
    const CutResult r = cut_under_hand(age);
    pass = pass && r.caught_up <= age.age + 0.06 && r.rise <= 1e-3 && r.surplus <= EnergyBook::G_allowed &&
           r.step_beyond <= 0.1;
    figure += fmt::format("{}{}: {:.0f} ms, rise {:.3f} N", figure.empty() ? "" : "; ", age.name,
                          1e3 * r.caught_up, std::max(0.0, r.rise));
  }
  return {"T5", "1 N on O1 (Touch, arm), whose stiffness falls to a fifth",
          "felt within 0.05 N of borne after age + 60 ms, never a rise; G <= 0.1 mJ; steps <= K v T + 0.1 N",
          figure, pass};
}

}  // namespace palpate::bench
