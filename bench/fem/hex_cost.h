#pragma once
// Time of a step of hexahedra per cell, on a cube that moves gently.

#include <vector>

#include "bench/problems/hex_cube.h"

namespace palpate::bench {

struct HexCost {
  HexCubeKind kind;
  double stable_step = 0;  // near rest, as it is damped [s]
  std::vector<double> ns;  // per cell and step, wall time, of each round

  double median_ns() const;
  double least_ns() const;
  /// Cells that frames of 1 ms can have in real time, in steps of at most 0.8 of the stable one.
  double cells_at_1_kHz() const;
};

/// Complete steps, masses held at the bottom, one of four watched for the books as a frame of four steps would.
/// All kinds in turns, so that what else the machine does falls on all alike.
std::vector<HexCost> measure_hex_costs(const std::vector<HexCubeKind>& kinds, int rounds);

}  // namespace palpate::bench
