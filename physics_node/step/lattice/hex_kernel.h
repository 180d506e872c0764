#pragma once
// All that the kernel of hexahedra needs for one step, and where it is.

#include <cmath>
#include <cstdint>

#include "common/scene/element_kinds.h"
#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/step/fem/hex_damper.h"
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
  const Real* damage;        // share of it that a cell has lost; only with torn                     (n_cells)
  Real* high[3];             // zero between steps [N]                                               (n_cells)
  Real* pulled[3];           // sum of both [N]; null: nobody asks                                (n_cells)
  double* elastic;           // of each run, when watched [J]
  double* least_J;           // least J of a corner of each run, when watched
  double* stiffest;          // bound of the tangent of the law in each run, largest of its cells [Pa]
  double* power;             // what dampers take from each run; only damped [W]
  double* damped;            // and took from it since the last step: see damper_loss() [J]
  Real* rate_low[3];  // of dampers alone, as f and high; zero between steps; only exact [N]     (n_cells)
  Real* rate_high[3];
  Real* rate_seen[3];  // and what they were one step ago
  double* passed;  // what dampers and terms took from each row of masses, in all; only damped or relaxing [J]
  Real* remembered[most_relaxations]
                  [n_remembered];  // by term; only where it relaxes                (n_cells)
  RelaxationTerm<Real> terms[most_relaxations];
  std::size_t n_terms;
  double* lost_before;  // of each run, by its terms since the last step and until the next: see TermNow [J]
  double* lost_after;
  Index up_y, up_z;
  Real beta;           // of the damper [s]
  Real damper_weight;  // see Damping [Pa]
  double dt_before;    // of the last step [s]
  bool books;          // there was one
  bool rate_known;     // and it was exact: rate_seen holds
  HexConstants<Real> k;
};

/// What a damper of the power Q takes between the steps n and n + 1. Its force works by the trapezoid (see element_step.h),
///
///   dt/2 (v . C v + v . C_n v_n),   v = v_(n+1/2), v_n = v_(n-1/2), C = C_(n+1): v . C v = Q_(n+1), v_n . C_n v_n = Q_n
///
/// and v . C_n v_n is sqrt(Q_n Q_(n+1)) where a cell goes on as it went, faster or slower. Where something strikes it may be
/// anything: exact steps gather C_n v_n at the nodes.
inline double damper_loss(double dt, double power_before, double power) {
  return 0.5 * dt * (power + std::sqrt(power_before * power));
}

struct HexKind {
  TissueLaw law = TissueLaw::neo_hookean;
  bool physical = true;
  bool damped = false;
  bool relaxing = false;  // only physical and neo-Hookean
  bool exact =
      false;  // books dampers as the integrator does it, at some cost; the motion has the same bits: ExplicitStep
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
