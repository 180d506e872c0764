#pragma once
// What is measured: the drop at many steps against a reference, steps of bodies of several sizes, and whether everybody
// solves the same equations.

#include <functional>
#include <string>
#include <vector>

#include "bench/peers/solver.h"

namespace palpate::bench {

struct Plan {
  int drop_masses = 10000;
  int drop_frames = 200;                          // of 1 ms
  std::vector<int> sizes = {1000, 10000, 70000};  // masses, for the time of a step
  double seconds = 0.4;                           // of a measurement of a step, roughly
  int repeats = 3;
};

/// Medians of the repeats, which go round all solvers in turn so that other work on the machine meets all alike.
struct Point {
  Method method;
  std::size_t masses = 0, springs = 0;
  double dt = 0;  // [s]
  int steps = 0;
  double cpu_s = 0, wall_s = 0;
  double error = 0;  // of the drop only
  double cpu_ns() const { return 1e9 * cpu_s / steps / static_cast<double>(masses); }
  double wall_ns() const { return 1e9 * wall_s / steps / static_cast<double>(masses); }
};

struct DropResult {
  double stable_step = 0;      // palpate's bound [s]
  double reference_dt = 0;     // [s]
  double reference_error = 0;  // of the reference itself, from half as many steps (Richardson, second order)
  std::vector<Point> points;   // sound runs, error below 1
  std::vector<std::string> unstable;  // "method at step": the others
};

/// Difference to palpate in double precision with the same scheme and step, relative to the displacement.
struct Agreement {
  Method method;
  double difference = 0;
};

using Say = std::function<void(const std::string&)>;  // progress

/// Root mean square difference over root mean square of `reference`; infinite where the numbers are not finite.
double relative_difference(const std::vector<Vec3>& x, const std::vector<Vec3>& reference);

DropResult measure_drop(const Plan& plan, const std::vector<Peer>& peers, const Say& say);
std::vector<Point> measure_steps(const Plan& plan, const std::vector<Peer>& peers, const Say& say);
std::vector<Agreement> measure_agreement(const std::vector<Peer>& peers);

}  // namespace palpate::bench
