#pragma once
// Random numbers that are the same on every machine: the engine is exact, and so are the numbers made of it but for the last
// digits of decades().

#include <cmath>
#include <cstdint>
#include <random>

#include "common/math/vec3.h"

namespace palpate::bench {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double between(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double decades(double lo, double hi) {  // log-uniform
    return std::exp(between(std::log(lo), std::log(hi)));
  }
  bool chance(double p) { return between(0, 1) < p; }
  int pick(int n) { return static_cast<int>(between(0, n)); }
  Vec3 within(double radius) {
    const double x = between(-radius, radius), y = between(-radius, radius);
    return {x, y, between(-radius, radius)};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace palpate::bench
