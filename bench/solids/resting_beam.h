#pragma once
// The cantilever of bench/problems/hex_beam.h, let go under its weight and stepped until it rests.

#include <cstdint>

#include "common/scene/element_kinds.h"

namespace palpate::bench {

/// Of the stable step. Why no more: see driven_body.cpp.
inline constexpr double beam_step_share = 0.3;

struct RestingBeam {
  static constexpr double gravity = 0.01;  // [m/s^2]; it sinks by 1.5 % of its length, as good as linear

  int cells = 0;    // over its height
  double sunk = 0;  // the end face, in the mean of its nodes, over gravity [s^2]
  bool at_rest = false;
  std::int64_t elements = 0, steps = 0;
  double cpu_s = 0;

  double ns_per_element() const {  // and step
    return 1e9 * cpu_s / (static_cast<double>(elements) * static_cast<double>(steps));
  }
};

/// In double precision, as the last of the way is too slow for single, on one thread. All velocities are set to zero whenever kinetic energy has passed a peak (driven_body.h).
/// @param poisson_ratio  of finite elements; springs have their own, 0.25
RestingBeam rest_beam(ElementModel model, HourglassKind hourglass, int cells, double poisson_ratio);

/// The same of another engine. Step once, and tell or stop what moves.
class BeamStepper {
 public:
  virtual ~BeamStepper() = default;
  virtual void step() = 0;
  virtual double kinetic() const = 0;  // [J]
  virtual void stop() = 0;
};
/// @return did it come to rest: was a peak of kinetic energy below `enough` of the largest?
/// @param steps  counts
bool settle(BeamStepper& beam, double enough, std::int64_t& steps);

}  // namespace palpate::bench
