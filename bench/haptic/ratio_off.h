#pragma once
// How far what is felt is from what is borne, as rows say it.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "bench/haptic/touch_trials.h"

namespace palpate::bench {

/// Largest distances of a ratio from 1, in amplitude and phase [deg].
struct RatioOff {
  double amplitude = 0, phase = 0;
  void add(const std::complex<double>& ratio) {
    amplitude = std::max(amplitude, std::abs(std::abs(ratio) - 1));
    phase = std::max(phase, std::abs(std::arg(ratio)) * (180 / std::numbers::pi));
  }
  bool within(double most_amplitude, double most_phase) const {
    return amplitude <= most_amplitude && phase <= most_phase;
  }
  std::string text() const { return fmt::format("{:.2f} %, {:.1f} deg", 100 * amplitude, phase); }
};

/// Of a peak or an impulse. @param measure  peak_of or impulse_of
inline double felt_off(const TouchRun& run, double (*measure)(const TouchRun&, double Touched::*)) {
  return std::abs(measure(run, &Touched::felt) / measure(run, &Touched::borne) - 1);
}

}  // namespace palpate::bench
