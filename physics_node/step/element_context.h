#pragma once
// All that the element kernel needs for one step, in the precision of the state. Rebuilt each step.

#include <cstdint>

#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

template <class Real>
struct ElementContext {
  const RowSegment* rows;
  Index offset[2][max_directions];  // to the neighbour, by row parity
  const Real* u[3];                 // displacement [m]                 (n_cells)
  const Real* v[3];                 // velocity [m/s]                   (n_cells)
  Real* next_u[3];                  // written                          (n_cells)
  Real* next_v[3];                  // written                          (n_cells)
  const Real* inverse_mass;         // 0: held or empty [1/kg]          (n_cells)
  const Mask* mask;                 // live elements                    (n_cells)
  Real dt, g[3];
  Real D[3][max_directions];  // rest vector to the neighbour [m]
  Real L[max_directions];     // its length [m]
  Real k1[max_directions], k2[max_directions], c[max_directions];
  const Real* l_c[max_half];  // plastic stretch [m]; only with yield   (n_cells)
  const Real* y_p[max_half];  // yield ratio now; only with yield       (n_cells)
};

/// What a body's material has: what it lacks is not in the loop.
struct KernelKind {
  bool fcc = false;
  bool damped = false;
  bool yields = false;
};

/// Steps the masses of some rows. See element_step.h for what it computes.
template <class Real>
using ElementKernel = void (*)(const ElementContext<Real>&, Index first_row, Index last_row);

/// The kernel of an instruction set; sse2 is every x86-64 machine's.
namespace sse2 {
template <class Real>
ElementKernel<Real> element_kernel(KernelKind kind);
}
namespace avx2 {
template <class Real>
ElementKernel<Real> element_kernel(KernelKind kind);
}
namespace avx512 {
template <class Real>
ElementKernel<Real> element_kernel(KernelKind kind);
}

enum class InstructionSet { sse2, avx2, avx512 };
/// The widest that this machine runs, or the narrower one that PALPATE_ISA names (sse2, avx2).
InstructionSet instruction_set() noexcept;
const char* name_of(InstructionSet set) noexcept;

}  // namespace palpate::physics
