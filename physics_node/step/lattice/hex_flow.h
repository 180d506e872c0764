#pragma once
// Looks for hexahedra that yield, lets them flow, and adds what their plastic shape does: see step/fem/hex_plastic.h. Vectors of
// cells at once, before the sweep of the kernel, to the same forces.

#include <cstdint>

#include "physics_node/step/fem/hex_plastic.h"
#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/kernel_choice.h"

namespace palpate::physics {

/// far: below half of its limit, and never yielded; only looked at in watched steps.
enum class Yielded : std::uint8_t { far, near, yielded };

/// What the cells of a run did in a step, or are.
struct RunYield {
  double plastic = 0;      // lost by this step's flow [J]
  double numerical = 0;    // and beside it, to the way time is stepped [J]
  double elastic = 0;      // beside the law's, when last watched [J]
  double stiffness = 0;    // beside the bound of the law's tangent [Pa]
  std::int64_t flows = 0;  // cells that flow in this step
  Yielded found = Yielded::near;
};

template <class Real>
struct HexFlowContext {
  const HexRun* runs;
  const std::uint8_t* acts;  // of each run, 0: all around it sleeps
  RunYield* of_run;
  const Real *u[3], *v[3];  // displacement [m], velocity [m/s]                     (n_cells)
  Real *f[3], *high[3];     // as in HexContext, added to [N]                       (n_cells)
  const Real* stiffness;    // of a cell in units of the body's own; 0: none        (n_cells)
  const Real* begun;        // of cells that break, above 0: it flows no more; null (n_cells)
  const Real* limit;        // YieldLimit of a cell; 0: it does not yield           (n_cells)
  const Real* hardening;    //                                                      (n_cells)
  Real* memory[n_plastic];  // Plastic                                              (n_cells)
  Index up_y, up_z;
  Real dt_before;  // of the step that led here [s]
  Real most_bent;  // most that 3 s . G(s) / (V mu) is of |s|^2 [1/m^2]
  bool watch;      // looks at all runs, and measures their energy
  HexConstants<Real> k;
};

struct HexFlowKind {};  // there is one

/// Of the runs [first, last).
template <class Real>
using HexFlowKernel = void (*)(const HexFlowContext<Real>&, Index first_run, Index last_run);

namespace sse2 {
template <class Real>
HexFlowKernel<Real> hex_flow_kernel(HexFlowKind kind);
}
namespace avx2 {
template <class Real>
HexFlowKernel<Real> hex_flow_kernel(HexFlowKind kind);
}
namespace avx512 {
template <class Real>
HexFlowKernel<Real> hex_flow_kernel(HexFlowKind kind);
}

/// Of the widest vectors that this machine has.
template <class Real>
HexFlowKernel<Real> hex_flow_kernel_here() {
  return kernel_for(instruction_set(), HexFlowKind{}, &sse2::hex_flow_kernel<Real>,
                    &avx2::hex_flow_kernel<Real>, &avx512::hex_flow_kernel<Real>);
}

}  // namespace palpate::physics
