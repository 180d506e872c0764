#pragma once
// One scene of abuse, run and checked after every frame.

#include <functional>
#include <string>
#include <vector>

#include "bench/stress/random_scene.h"

namespace palpate::bench {

/// Largest growth that passes. See StressResult::growth.
inline constexpr double growth_bound = 10.0;

struct StressResult {
  std::uint64_t seed = 0;
  std::string integrator, lattice, precision, start;
  std::int64_t masses = 0, steps = 0;
  double step_ratio = 0;
  bool finite = true;  // every position and velocity that ever left frame()
  /// Largest kinetic and elastic energy after any frame, over the most that had been put in by then: the same at the start,
  /// work of gravity, and of the tools, which counts as put in whatever its sign. 1 where energy is kept; nothing put in counts as 1e-9 of the sum of k1 L^2.
  double growth = 0;
  std::int64_t restored = 0;  // times that the guard acted
  std::string diagnosis;      // why the scene stopped; "none" while it did not
  double cpu_s = 0;

  bool passes() const { return finite && growth <= growth_bound; }
};

StressResult run_stress(std::uint64_t seed, ElementModel model = ElementModel::springs,
                        const std::function<void(const std::string&)>& say = {});

const std::vector<std::string>& stress_heading();
std::vector<std::string> words(const StressResult& result);
/// From a line that words() made. @return false if it is cut short
bool parse(const std::string& line, StressResult& result);

}  // namespace palpate::bench
