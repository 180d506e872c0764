#pragma once
// The cantilever of bench/problems/hex_beam.h, of springs.

namespace palpate::bench {

struct SpringBeam {
  double ratio =
      0;  // how far the end face sinks over what Timoshenko's beam of the springs' own Poisson ratio does
};

/// @param cells  over its height
SpringBeam spring_beam(int cells);

}  // namespace palpate::bench
