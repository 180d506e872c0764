#pragma once
// The reference problems of `palpate bench error` and of the tests. Each stands in a file of its own with its equation.

#include <string>
#include <vector>

#include "bench/problems/settings.h"

namespace palpate::bench {

// --- one element: two masses, against closed forms ---
Outcome oscillation(const Settings& settings);  // oscillation.cpp
Outcome creep(const Settings& settings);        // creep.cpp
Outcome breaking(const Settings& settings);     // breaking.cpp
/// Largest error of the tension round a loop of loading and unloading, relative to k1 L. The mass is led at `speed` [m/s]
/// with `steps` commits of the memory from turn to turn.                                         bilinear_loop.cpp
double bilinear_loop_error(double speed, int steps, Precision precision = Precision::double_);

// --- many elements, against the lattice's own answers ---
/// Relative error of the frequency of the standing wave number `mode` of a chain of `n` elements.           chain.cpp
Outcome chain_wave(const Settings& settings, int n, int mode);
/// How far a damped bar comes to rest from its equilibrium, relative to its stretch.                          bar.cpp
Outcome bar_stretch(const Settings& settings, LatticeKind lattice);
/// Young's modulus of the lattice, from stress and strain in the middle of a hanging bar `cells` wide.        modulus.cpp
struct Modulus {
  double inside = 0;   // from stress and strain in the middle of the bar, relative to the modulus asked for
  double outside = 0;  // weight below the middle over nominal section and strain, relative to the same
  std::int64_t masses = 0;
};
Modulus bar_modulus(LatticeKind lattice, int cells);

/// Change of momentum and angular momentum of a flying, spinning, shaken body, each relative to its size.     free_flight.cpp
struct Drift {
  double linear = 0, angular = 0;
  Outcome outcome;
};
Drift free_flight(const Settings& settings, LatticeKind lattice, int steps);

// --- many elements, against the same scene at a tiny step ---
Outcome cube_drop(const Settings& settings, LatticeKind lattice, double spacing);  // drop.cpp
Outcome vessel_release(const Settings& settings);                                  // drop.cpp

/// A problem as the sweep sees it.
struct Problem {
  std::string name;
  std::string error_is;  // relative to what
  double longest_step;   // [s] of the sweep; explicit integrators are stable up to about here
  int halvings;          // of it
  bool smooth;           // without events: the order of the integrator can be seen
  bool many_masses;      // enough for a second thread to be of interest
  std::function<Outcome(const Settings&)> solve;
};
const std::vector<Problem>& problems();

}  // namespace palpate::bench
