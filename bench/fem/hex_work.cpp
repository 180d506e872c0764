#include "bench/fem/hex_work.h"

#include <array>

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_relaxation.h"

namespace palpate::bench {
namespace {

thread_local double counted = 0;

/// A number whose operations count, and that is zero.
struct Counting {
  friend Counting operator+(Counting, Counting) { return one(); }
  friend Counting operator-(Counting, Counting) { return one(); }
  friend Counting operator*(Counting, Counting) { return one(); }
  Counting operator-() const { return {}; }  // part of a fused operation
  Counting& operator+=(Counting) { return counted += 1, *this; }
  friend bool operator>(Counting, Counting) { return true; }

 private:
  static Counting one() { return counted += 1, Counting{}; }
};

struct CountingPack {
  using V = Counting;
  using Number = double;
  static V all(double) noexcept { return {}; }
  static V fma(V, V, V) noexcept { return counted += 2, V{}; }
};

}  // namespace

double flops_per_cell(const HexCubeKind& kind) {
  using physics::StableNeoHookean;
  const physics::HexConstants<double> k;
  physics::HexForces<CountingPack> out;
  counted = 0;
  if (kind.relaxing) {
    std::array<physics::RelaxationTerm<double>, 1> term;
    std::array<physics::Remembered<Counting>, 1> remembered;
    physics::Relaxing<CountingPack, double> memory{term, remembered};
    physics::hex_forces<CountingPack, StableNeoHookean, true, false>(k, {}, out, memory);
  } else if (kind.hourglass == HourglassKind::physical) {
    physics::hex_forces<CountingPack, StableNeoHookean, true, false>(k, {}, out);
  } else {
    physics::hex_forces<CountingPack, StableNeoHookean, false, false>(k, {}, out);
  }
  const double scaled_and_added = 2 * 24,
               moved = 18 + 3;  // the two sums of a mass, v + dt (f w + g), u + dt v
  return counted + scaled_and_added + moved + (kind.damped ? 2 * 24 : 0);
}

double bytes_per_cell(const HexCubeKind& kind) {
  const double forces = 3 + 1 + 2 * 6;     // u; stiffness; low and high, read and written
  const double moves = 4 * 3 + 1 + 2 * 6;  // u, v read and written; inverse mass; low and high
  const double of_damper = 3 + 2 * 6;      // v; what the last step saw
  const double of_memory = 2.0 * physics::n_remembered;
  return (kind.precision == Precision::single_ ? 4 : 8) *
         (forces + moves + (kind.damped ? of_damper : 0) + (kind.relaxing ? of_memory : 0));
}

}  // namespace palpate::bench
