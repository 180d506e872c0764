#pragma once
// V-cycles: how many a system takes, what one costs, and what a frame of backward_euler does.

#include <vector>

#include "bench/problems/solid_shapes.h"

namespace palpate::bench {

struct CycleCost {
  SolidKind kind;
  int threads = 1;
  int cells = 0;         // that are there
  int to_hundredth = 0;  // V-cycles until the residual is 1e-2 of the first
  int to_ten_thousandth = 0;
  double cycle_ns = 0;    // per cell, with the iteration around it; least of the rounds
  double tangent_ns = 0;  // taking the tangent, and factors of the coarsest level; likewise
};

/// Of a push on nine nodes at the top, in a frame of 20 ms from rest, in single precision.
CycleCost measure_cycles(const SolidKind& kind, int threads, int rounds);

struct FrameCost {
  SolidKind kind;
  int threads = 1;
  int cells = 0;
  double newton = 0, cycles = 0;  // a frame
  double implicit_ns = 0;         // per cell and frame of 20 ms
  double explicit_ns = 0;         // per cell and step
  double explicit_step = 0;       // 0.8 of the stable one [s]

  double cells_in_real_time() const { return frame / (1e-9 * implicit_ns); }
  double explicit_cells_in_real_time() const {
    return frame / (1e-9 * explicit_ns) / (frame / explicit_step);
  }
  /// Frames longer than this are cheaper implicitly, if a frame costs what one of 20 ms does. [s]
  double break_even() const { return explicit_step * implicit_ns / explicit_ns; }
  static constexpr double frame = 0.02;  // [s]
};

/// A cube whose top is pushed harder in every frame, up to a tenth of its height in 25 frames; medians over frames 2 to 25.
FrameCost measure_frames(const SolidKind& kind, int threads);

}  // namespace palpate::bench
