#pragma once
// How fast a scene will run, from its step, its masses and what a mass costs. Without contact, tools and
// breaking: an upper bound on a machine like the one of docs/benchmarks.md, good to a factor of two.

#include <span>

#include "physics_node/body/body.h"

namespace palpate::physics {

/// Most steps that a frame may be cut into. Why: a mass alone then takes 2 ms a frame; beyond, a scene stands
/// still.
inline constexpr double most_steps_a_frame = 1e5;

struct SpeedForecast {
  double steps_a_frame = 1;
  double real_time_factor =
      0;  // simulated per wall time on one thread; 0: nothing moves, or it is not known (backward_euler)
};

/// @param masses     in each body of the scene, that are stepped
/// @param stable_dt  stable step [s]; infinite where nothing limits it
SpeedForecast forecast_speed(const Scene& scene, std::span<const double> masses, double stable_dt);

/// @throws InputError: the step is so short that a frame would take more than most_steps_a_frame
double steps_a_frame(const Scene& scene, double stable_dt);

}  // namespace palpate::physics
