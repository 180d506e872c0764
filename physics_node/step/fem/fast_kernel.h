#pragma once
// Cells that are stepped on their own, many times in a step of the body: their kernel, and what it works on.

#include <cstddef>
#include <cstdint>

#include "common/scene/element_kinds.h"
#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/step/lattice/kernel_choice.h"

namespace palpate::physics {

/// Why sixteen: the lanes of the widest vector. Narrower ones take a batch in parts, and what a lane holds is its own.
inline constexpr std::size_t fast_lanes = 16;
/// Numbers of forces that a batch writes: by corner, component, lane.
inline constexpr std::size_t forces_of_a_batch = 8 * 3 * fast_lanes;

/// Cells write their forces side by side, and each node sums those that are its own: a sum has one order on any number of threads
/// and at any width. Nodes are numbered anew, four numbers each, of which the last is idle.
template <class Real>
struct FastContext {
  // by lane of a batch:
  const std::int32_t*
      corner;  // 4 x node, by corner and lane; a lane without a cell has those of another  (8 x lanes)
  const Real* stiffness;  // in units of the body's own; 0: no cell                                    (lanes)
  Real* power;            // that dampers took when they were last looked at [W]
  Real* lost;             // to them so far: see damper_loss() [J]
  Real* elastic;          // when watched [J]
  Real* least_change;     // least J - 1 of a corner, when watched
  Real* stiffest;         // bound of the law's tangent, largest so far [Pa]
  Real* force;            // (batches x forces_of_a_batch, and as many zeros as a lane of forces reaches over)
  // by node:
  const std::int32_t* incident;  // of the forces on it, the first component; of none: the zeros  (8 x nodes)
  const Real* dt_over_mass;      // 0: it stands [s/kg]
  const Real* kick;              // of forces that stay the same in all substeps [m/s]
  Real *u, *v;                   // [m, m/s]
  Real *sum_v, *sum_sum_v;       // of all substeps so far, and of these sums before each
  Real dt = 0;                   // of a substep [s]
  Real dt_before = 0;            // of the one before; 0: there was none [s]
  Real beta = 0;                 // of the damper [s]
  Real damper_weight = 0;        // see Damping [Pa]
  HexConstants<Real> k;
};

struct FastKind {
  TissueLaw law = TissueLaw::neo_hookean;
  bool physical = true;
};

template <class Real>
struct FastKernel {
  /// Forces of the batches [first, last).
  void (*forces)(const FastContext<Real>&, std::size_t first, std::size_t last) = nullptr;
  void (*watched_forces)(const FastContext<Real>&, std::size_t first, std::size_t last) = nullptr;
  /// Moves the nodes [first, last) by a substep.
  void (*move)(const FastContext<Real>&, std::size_t first, std::size_t last) = nullptr;
};

namespace sse2 {
template <class Real>
FastKernel<Real> fast_kernel(FastKind kind);
}
namespace avx2 {
template <class Real>
FastKernel<Real> fast_kernel(FastKind kind);
}
namespace avx512 {
template <class Real>
FastKernel<Real> fast_kernel(FastKind kind);
}

/// Of the widest vectors that this machine has.
template <class Real>
FastKernel<Real> fast_kernel_here(FastKind kind) {
  return kernel_for(instruction_set(), kind, &sse2::fast_kernel<Real>, &avx2::fast_kernel<Real>,
                    &avx512::fast_kernel<Real>);
}

}  // namespace palpate::physics
