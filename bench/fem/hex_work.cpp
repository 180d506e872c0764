#include "bench/fem/hex_work.h"

#include <array>

#include "bench/fem/counting.h"
#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_damper.h"

namespace palpate::bench {

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
  } else if (kind.damped) {
    const physics::Corners<CountingPack> v{};
    physics::Damping<CountingPack, double> damping{.v = &v};
    if (kind.hourglass == HourglassKind::physical)
      physics::hex_forces<CountingPack, StableNeoHookean, true, false>(k, {}, out, damping);
    else
      physics::hex_forces<CountingPack, StableNeoHookean, false, false>(k, {}, out, damping);
  } else if (kind.hourglass == HourglassKind::physical) {
    physics::hex_forces<CountingPack, StableNeoHookean, true, false>(k, {}, out);
  } else {
    physics::hex_forces<CountingPack, StableNeoHookean, false, false>(k, {}, out);
  }
  const double scaled_and_added = 2 * 24,
               moved = 18 + 3;  // the two sums of a mass, v + dt (f w + g), u + dt v
  return counted + scaled_and_added + moved;
}

double bytes_per_cell(const HexCubeKind& kind) {
  const double forces = 3 + 1 + 2 * 6;     // u; stiffness; low and high, read and written
  const double moves = 4 * 3 + 1 + 2 * 6;  // u, v read and written; inverse mass; low and high
  const double of_damper = 3;              // v
  const double of_memory = 2.0 * physics::n_remembered;
  return (kind.precision == Precision::single_ ? 4 : 8) *
         (forces + moves + (kind.damped ? of_damper : 0) + (kind.relaxing ? of_memory : 0));
}

}  // namespace palpate::bench
