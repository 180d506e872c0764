// Is what the hand feels of real tissue what the tissue bears? Sines, taps and a step that is held, with the real
// physics library and the real controller. What tissue bears is known of the sample that ends a frame; of every
// sample it is known at 1 kHz without delay, the first of the ages: the ideal coupling.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "bench/haptic/ratio_off.h"
#include "bench/haptic/rows_touch.h"
#include "bench/haptic/same_samples.h"
#include "bench/problems/side_by_side.h"

namespace palpate::bench {
namespace {

using std::numbers::pi;

constexpr const char* solid = "model = \"fem\"";
constexpr SlabModel viscous_slab{"viscous slab, elements",
                                 "modulus_kPa = 30\npoisson_ratio = 0.45\nviscosity_Pa_s = 150",
                                 false,
                                 400,
                                 false,
                                 solid};
constexpr SlabModel relaxing_slab{"relaxing slab, elements",
                                  "modulus_kPa = 60\npoisson_ratio = 0.45\nviscosity_Pa_s = 20\n"
                                  "relaxation = [[0.3, 0.1], [0.2, 1]]",
                                  false,
                                  400,
                                  false,
                                  solid};
constexpr std::array true_slabs{&slab_models[0], &slab_models[1], &solid_slabs[0],
                                &solid_slabs[1], &viscous_slab,   &relaxing_slab};

std::vector<const SlabModel*> slabs_of(const Runs& runs) {
  if (runs.effort == Effort::quick) return {&slab_models[0], &solid_slabs[1], &relaxing_slab};
  return {true_slabs.begin(), true_slabs.end()};
}

/// A motion, and the part of it that counts [s].
struct Motion {
  Path path;
  double begin, end;
};

Motion swing(double frequency_Hz) {
  constexpr double above = 5e-3, depth = 2e-3, by = 0.5e-3, down = 0.5, wait = 1.0, ramp = 0.5;
  const double begin = wait + ramp + 0.3;
  return {straight_down([=](double t) {
            return -above + (above + depth) * haversine(t, down) +
                   by * haversine(t - wait, ramp) * std::sin(2 * pi * frequency_Hz * t);
          }),
          begin, begin + std::max(2.0, std::ceil(frequency_Hz)) / frequency_Hz};
}

constexpr int n_taps = 3;
constexpr double tap_every = 0.4, first_tap = 0.2;  // [s]

Motion taps() {
  constexpr double clear = 3e-3, depth = 2e-3, time = 0.1;
  return {straight_down([=](double t) {
            const double since = std::fmod(std::max(0.0, t - first_tap), tap_every);
            const double s = t < first_tap + n_taps * tap_every ? std::min(since / time, 1.0) : 1.0;
            return -clear + (clear + depth) * (0.5 - 0.5 * std::cos(2 * pi * s));
          }),
          0.0, first_tap + n_taps * tap_every};
}

struct Tap {
  double peak = 0, impulse = 0;  // [N], and in samples
};
Tap tap_in(const std::map<std::uint64_t, Vec3>& forces, int number) {
  Tap tap;
  const double begin = first_tap + number * tap_every;
  for (const auto& [sample, force] : forces)
    if (const double t = time_of(sample); t >= begin && t < begin + tap_every) {
      tap.peak = std::max(tap.peak, force.z());
      tap.impulse += force.z();
    }
  return tap;
}

Motion press_and_hold() {
  constexpr double above = 0.2e-3, depth = 2e-3, begin = 0.1, speed = depth / 20e-3, hold = 2.9;
  return {straight_down([=](double t) { return std::clamp(-above + speed * (t - begin), -above, depth); }),
          0.0, begin + 20e-3 + hold};
}

/// The same motion at an age and without delay.
struct Pair {
  const SlabModel* slab = nullptr;
  SameSamples late, ideal;
};

/// @return of each slab in turn at each age
std::vector<Pair> follow_all(const std::vector<const SlabModel*>& slabs, const Motion& motion, int jobs) {
  // 0.2 s more, so that tissue comes to the end.
  const double until = motion.end + 0.2;
  std::vector<Pair> pairs(slabs.size() * link_ages.size());
  side_by_side(pairs.size(), jobs, [&](std::size_t i) {
    const std::size_t slab = i / link_ages.size(), age = i % link_ages.size();
    pairs[i].slab = slabs[slab];
    pairs[i].late = follow(slab_case(*slabs[slab], link_ages[age]), motion.path, motion.begin, until);
  });
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].ideal = pairs[i - i % link_ages.size()].late;
  return pairs;
}

/// What of forces swings with a frequency, over the samples that count.
std::complex<double> swings(const std::map<std::uint64_t, Vec3>& forces, const Motion& motion,
                            double frequency_Hz) {
  std::complex<double> sum = 0;
  for (const auto& [sample, force] : forces)
    if (const double t = time_of(sample); t >= motion.begin && t < motion.end - 1e-9)
      sum += force.z() * std::polar(1.0, -2 * pi * frequency_Hz * t);
  return sum;
}

/// Largest difference of what is borne at an age from the ideal, over the largest of that.
double borne_off(const Pair& pair) {
  double off = 0, most = 0;
  for (const auto& [sample, force] : pair.late.borne)
    if (const auto at = pair.ideal.borne.find(sample); at != pair.ideal.borne.end()) {
      off = std::max(off, (force - at->second).norm());
      most = std::max(most, at->second.norm());
    }
  return off / most;
}

}  // namespace

Row world_tissue_swings(Runs& runs) {
  RatioOff felt, flowing;
  double borne = 0, surplus = 0;
  const std::vector<double> frequencies =
      runs.effort == Effort::quick ? std::vector<double>{10, 20} : touch_frequencies(runs.effort);
  for (const double frequency : frequencies) {
    const Motion motion = swing(frequency);
    const std::vector<Pair> pairs = follow_all(slabs_of(runs), motion, runs.jobs);
    for (const Pair& pair : pairs) {
      const std::complex<double> ratio =
          swings(pair.late.felt, motion, frequency) / swings(pair.ideal.borne, motion, frequency);
      (pair.slab == &viscous_slab || pair.slab == &relaxing_slab ? flowing : felt).add(ratio);
      borne = std::max(borne, borne_off(pair));
      surplus = std::max(surplus, pair.late.surplus);
    }
  }
  return {
      "T1",
      "real library and controller: 0.5 mm about 2 mm, 0.5 to 20 Hz, ages of 2, 20, 100 ms (10 % loss); "
      "slabs of springs and of elements, 30 and 100 kPa; apart a viscous one (5 ms) and one that relaxes",
      "felt / borne within 6 %, 6 deg; of what flows 6 %, 7 deg; borne / ideal within 5 %; G <= 0.1 mJ",
      fmt::format("felt off by {}; of what flows {}; borne by {:.2f} %; G {:.3f} mJ", felt.text(),
                  flowing.text(), 100 * borne, 1e3 * surplus),
      felt.within(0.06, 6) && flowing.within(0.06, 7) && borne <= 0.05 && surplus <= EnergyBook::G_allowed};
}

Row world_tissue_taps(Runs& runs) {
  struct Off {
    double peak = 0, impulse = 0;

    std::string text() const {
      return fmt::format("peak off by {:.2f} %, impulse by {:.2f} %", 100 * peak, 100 * impulse);
    }
    bool within(double of_peak, double of_impulse) const { return peak <= of_peak && impulse <= of_impulse; }
  };
  std::array<Off, n_taps> off{};
  Off viscous;
  double surplus = 0;
  for (const Pair& pair : follow_all(slabs_of(runs), taps(), runs.jobs)) {
    surplus = std::max(surplus, pair.late.surplus);
    for (int n = 0; n < n_taps; ++n) {
      Off& of = pair.slab == &viscous_slab ? viscous : off[static_cast<std::size_t>(n)];
      const Tap felt = tap_in(pair.late.felt, n), borne = tap_in(pair.ideal.borne, n);
      of.peak = std::max(of.peak, std::abs(felt.peak / borne.peak - 1));
      of.impulse = std::max(of.impulse, std::abs(felt.impulse / borne.impulse - 1));
    }
  }
  const Off &first = off.front(), &last = off.back();
  return {
      "T2",
      "the same slabs: three taps of 0.1 s, 2 mm deep, from 3 mm above, all ages; the viscous one apart",
      "felt / borne, the first and the third: peak within 5 %, impulse within 2 %; all of the viscous one: "
      "5 %, 4 %; G <= 0.1 mJ",
      fmt::format("the first: {}; the third: {}; the viscous one: {}; G {:.3f} mJ", first.text(), last.text(),
                  viscous.text(), 1e3 * surplus),
      first.within(0.05, 0.02) && last.within(0.05, 0.02) && viscous.within(0.05, 0.04) &&
          surplus <= EnergyBook::G_allowed};
}

Row world_tissue_relaxes(Runs& runs) {
  double worst = 0;
  for (const Pair& pair : follow_all(slabs_of(runs), press_and_hold(), runs.jobs)) {
    double off = 0, whole = 0;
    for (const auto& [sample, force] : pair.ideal.borne)
      if (const auto at = pair.late.felt.find(sample); at != pair.late.felt.end()) {
        off += (at->second - force).squaredNorm();
        whole += force.squaredNorm();
      }
    worst = std::max(worst, std::sqrt(off / whole));
  }
  return {"T3", "the same slabs: 2 mm pressed in 20 ms and held for 2.9 s, all ages",
          "root mean square of felt less borne within 1 %", fmt::format("{:.2f} %", 100 * worst),
          worst <= 0.01};
}

}  // namespace palpate::bench
