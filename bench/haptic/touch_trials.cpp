#include "bench/haptic/touch_trials.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::bench {
namespace {

using std::numbers::pi;

/// The force of each true sample without delay.
void fill_ideal(const Case& c, const std::vector<HandSample>& truth, std::size_t first,
                std::vector<Touched>& samples) {
  const SpecimenModel model = c.specimen != nullptr ? *c.specimen : specimen_of(c.object);
  PressedTissue ideal(model, {}, {c.stiffness, c.damping});
  const HandSamples all{truth.size(), truth};
  ideal.frame(&all, 0);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].ideal = ideal.borne(first + i);
}

std::complex<double> amplitude(const std::vector<Touched>& samples, std::size_t begin, double frequency_Hz,
                               const std::function<double(std::size_t)>& force) {
  std::complex<double> sum = 0;
  for (std::size_t i = begin; i < samples.size(); ++i)
    sum += force(i) * std::polar(1.0, -2 * pi * frequency_Hz * samples[i].t);
  return sum;
}

}  // namespace

Case led_case(const SpecimenModel& specimen, const LinkAge& age) {
  Case c;
  c.device = device_models[3];
  c.specimen = &specimen;
  c.rate_Hz = age.rate_Hz;
  c.link.delay = age.delay;
  c.link.loss = age.loss;
  c.mode = RenderMode::copy;
  return c;
}

Case todays_case(const ObjectModel& object, const LinkAge& age) {
  Case c = led_case(chain_of_ten, age);
  c.specimen = nullptr;
  c.object = object;
  c.mode = RenderMode::local;
  return c;
}

double haversine(double t, double time) noexcept {
  return 0.5 - 0.5 * std::cos(pi * std::clamp(t / time, 0.0, 1.0));
}

Path path_of(std::function<Vec3(double)> place) {
  return [place = std::move(place)](double t) {
    constexpr double dt = 1e-6;
    Aim aim;
    aim.q = place(t);
    if (t > dt) aim.q_dot = (place(t + dt) - place(t - dt)) / (2 * dt);
    return aim;
  };
}

Path straight_down(std::function<double(double)> depth) {
  return path_of([depth = std::move(depth)](double t) { return Vec3(0, 0, -depth(t)); });
}

TouchRun lead_hand(const Case& c, const Path& path, double until) {
  Trial trial(c, path);
  trial.kinematic = true;
  TouchRun run;
  std::vector<HandSample> truth;
  HandSample now{-trial.plant().x().z(), 0};
  std::size_t first = 0;  // sample number at t = 0
  trial.run(until, [&] {
    truth.push_back(now);
    now = {-trial.plant().x().z(), -trial.plant().v().z()};
    const double t = trial.t() - 1e-3;
    if (t < -1e-9) return;
    if (first == 0) first = truth.size();
    const double command = trial.rendered().force.z();
    const bool copies = c.mode == RenderMode::copy;
    run.samples.push_back({t, truth.back().x, copies ? trial.touch().felt().z() : command, command,
                           copies ? 0.0 : trial.tissue().load(), 0.0});
  });
  if (const PressedTissue* pressed = trial.pressed()) {
    const std::size_t come = pressed->stamp() >= first ? pressed->stamp() - first + 1 : 0;
    run.samples.resize(std::min(run.samples.size(), come));
    for (std::size_t i = 0; i < run.samples.size(); ++i) run.samples[i].borne = pressed->borne(first + i);
  }
  fill_ideal(c, truth, first, run.samples);
  run.surplus = trial.energy().surplus();
  run.made = trial.touch().made();
  run.step_beyond = trial.force_step_beyond_motion();
  return run;
}

SineResult feel_sine(const Case& c, double frequency_Hz) {
  constexpr double above = 5e-3, depth = 2e-3, swing = 0.5e-3, down = 0.5, wait = 1.0, ramp = 0.5;
  const double cycles = std::max(2.0, std::ceil(frequency_Hz)), window = cycles / frequency_Hz;
  const auto at = [=](double t) {
    return -above + (above + depth) * haversine(t, down) +
           swing * haversine(t - wait, ramp) * std::sin(2 * pi * frequency_Hz * t);
  };
  // 0.2 s more, so that the tissue comes to the end of the window.
  const double begin = wait + ramp + 0.3, end = begin + window;
  TouchRun run = lead_hand(c, straight_down(at), end + 0.2);
  const auto first = static_cast<std::size_t>(std::lround(begin * 1e3));
  const auto count = static_cast<std::size_t>(std::lround(window * 1e3));
  std::vector<Touched> samples(run.samples.begin(),
                               run.samples.begin() + static_cast<std::ptrdiff_t>(first + count + 2));
  const auto last_borne = [&](std::size_t i) {
    return 0.5 * (run.samples[i + 1].borne + run.samples[i + 2].borne);
  };
  samples.resize(first + count);
  const auto of = [&](double Touched::*force) {
    return amplitude(samples, first, frequency_Hz, [&](std::size_t i) { return samples[i].*force; });
  };
  const std::complex<double> felt = of(&Touched::felt), borne = of(&Touched::borne),
                             ideal = of(&Touched::ideal);
  return {felt / borne, borne / ideal,
          felt / ideal, of(&Touched::command) / amplitude(samples, first, frequency_Hz, last_borne),
          run.surplus,  run.made};
}

TouchRun tap(const Case& c, double time, double clear) {
  constexpr double depth = 2e-3, begin = 0.2;
  const auto at = [=](double t) {
    const double s = std::clamp((t - begin) / time, 0.0, 1.0);
    return -clear + (clear + depth) * (0.5 - 0.5 * std::cos(2 * pi * s));
  };
  return lead_hand(c, straight_down(at), begin + time + 1.0);
}

double peak_of(const TouchRun& run, double Touched::*force) {
  double most = 0;
  for (const Touched& s : run.samples) most = std::max(most, s.*force);
  return most;
}

double impulse_of(const TouchRun& run, double Touched::*force) {
  double sum = 0;
  for (const Touched& s : run.samples) sum += 1e-3 * s.*force;
  return sum;
}

double relaxation_error(const Case& c) {
  constexpr double above = 0.2e-3, depth = 2e-3, begin = 0.1, speed = depth / 20e-3;
  const auto at = [=](double t) { return std::clamp(-above + speed * (t - begin), -above, depth); };
  const TouchRun run = lead_hand(c, straight_down(at), begin + 0.02 + 2.9 + 0.2);
  double error = 0, whole = 0;
  for (const Touched& s : run.samples) {
    error += (s.felt - s.ideal) * (s.felt - s.ideal);
    whole += s.ideal * s.ideal;
  }
  return std::sqrt(error / whole);
}

CutResult cut_under_hand(const LinkAge& age) {
  Case c = todays_case(object_models[1], age);
  c.mode = RenderMode::copy;
  c.device = device_models[0];
  c.hand = hand_springs[1];
  constexpr double cut_at = 2.0;
  Trial trial(c, press_path(c));
  trial.alter_specimen = [](Specimen& tissue, double t) { tissue.weaken(t < cut_at ? 1.0 : 0.2); };
  std::vector<std::pair<double, double>> felt;  // with the time
  trial.run(4.0, [&] { felt.emplace_back(trial.t() - 1e-3, trial.touch().felt().z()); });
  CutResult result;
  double before = 0;
  for (std::size_t i = 0; i < felt.size() && i + 1 <= trial.pressed()->stamp(); ++i) {
    const auto [t, force] = felt[i];
    if (t >= cut_at - 0.1 && t < cut_at) before = std::max(before, force);
    if (t < cut_at) continue;
    result.rise = std::max(result.rise, force - before);
    if (std::abs(force - trial.pressed()->borne(i + 1)) > 0.05) result.caught_up = t - cut_at + 1e-3;
  }
  result.surplus = trial.energy().surplus();
  result.step_beyond = trial.force_step_beyond_motion();
  return result;
}

}  // namespace palpate::bench
