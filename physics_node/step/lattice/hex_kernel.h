#pragma once
// All that the kernel of hexahedra needs for one step, and where it is.

#include <cstdint>

#include "common/scene/element_kinds.h"
#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/step/fem/hex_relaxation.h"
#include "physics_node/step/lattice/element_context.h"
#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/kernel_choice.h"

namespace palpate::physics {

/// Cells give to the corners of their lower plane through `low` and to those of their upper one through `high`, so that two
/// layers never write to the same number, and a sum has the same order on any number of threads.
template <class Real>
struct HexContext {
  ElementContext<Real> masses;  // how they move; its f is `low`
  const HexRun* runs;
  const Index* runs_of_row;
  const std::uint8_t* acts;  // of each run, 0: all around it sleeps; null: all act
  const Real* stiffness;     // of a cell in units of the body's own, by its lowest corner; 0: none  (n_cells)
  const std::uint8_t* torn;  // of each run, 1: cells have lost stiffness; null: none ever does
  const Real*
      damage;       // share of it that a cell has lost; only with torn                             (n_cells)
  Real* high[3];    // zero between steps [N]                                               (n_cells)
  Real* seen_v[3];  // velocity and force one step ago; only damped [m/s, N]                (n_cells)
  Real* seen_f[3];
  double* elastic;   // of each run at u, when watched [J]
  double* ahead;     // how much more it would be at u + beta v, when watched; only damped [J]
  double* least_J;   // least J of a corner of each run, when watched
  double* stiffest;  // bound of the tangent of the law in each run, largest of its cells [Pa]
  double*
      passed;  // what dampers and terms took from each row of masses, and `ahead`, in all; only damped or relaxing [J]
  Real* remembered[most_relaxations]
                  [n_remembered];  // by term; only where it relaxes                (n_cells)
  RelaxationTerm<Real> terms[most_relaxations];
  std::size_t n_terms;
  double* lost_before;  // of each run, by its terms since the last step and until the next: see TermNow [J]
  double* lost_after;
  Index up_y, up_z;
  Real beta;   // of the damper: forces act as if the body were at u + beta v [s]
  bool books;  // there was a step one step ago
  HexConstants<Real> k;
};

struct HexKind {
  TissueLaw law = TissueLaw::neo_hookean;
  bool physical = true;
  bool damped = false;
  bool relaxing = false;  // only physical and neo-Hookean
};

template <class Real>
struct HexKernel {
  void (*forces)(const HexContext<Real>&, Index first_run, Index last_run) = nullptr;
  void (*move)(const HexContext<Real>&, Index first_row, Index last_row) = nullptr;
};

namespace sse2 {
template <class Real>
HexKernel<Real> hex_kernel(HexKind kind);
}
namespace avx2 {
template <class Real>
HexKernel<Real> hex_kernel(HexKind kind);
}
namespace avx512 {
template <class Real>
HexKernel<Real> hex_kernel(HexKind kind);
}

/// Of the widest vectors that this machine has.
template <class Real>
HexKernel<Real> hex_kernel_here(HexKind kind) {
  return kernel_for(instruction_set(), kind, &sse2::hex_kernel<Real>, &avx2::hex_kernel<Real>,
                    &avx512::hex_kernel<Real>);
}

}  // namespace palpate::physics
