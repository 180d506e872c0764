#pragma once
// What a hard lump in soft tissue costs, with small steps for all of it and for the lump alone.

#include <cstddef>
#include <vector>

namespace palpate::bench {

struct LumpKind {
  double contrast = 100;  // of moduli
  double lag = 1e-4;      // viscosity over modulus [s]
  double share = 0.03;    // of the cells
  bool subcycle = true;   // where it pays
};

struct LumpCost {
  LumpKind kind;
  std::size_t cells = 0, fast_cells = 0;
  double step = 0;         // of the body [s]
  std::vector<double> ns;  // per cell and frame of 1 ms, wall time of one thread, of each round

  double median_ns() const;
  /// Cells that frames of 1 ms can have in real time.
  double cells_at_1_kHz() const { return 1e6 / median_ns(); }
};

/// Whole frames of a cube of tissue (10 kPa, nu 0.45, 1000 kg/m^3, cells of 2.5 mm), bottom held, with a ball in the middle, that moves gently.
/// All kinds in turns. @param along  cells along a side
std::vector<LumpCost> measure_lumps(const std::vector<LumpKind>& kinds, int along, int rounds);

}  // namespace palpate::bench
