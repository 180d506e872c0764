#pragma once
// Which runs of hexahedra have a cell that begins to break, or one near to it: see step/fem/hex_tension.h. Vectors of cells at once,
// so that looking costs a fraction of a step; who must break is then found one by one.

#include <cstdint>

#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/kernel_choice.h"

namespace palpate::physics {

enum class Strained : std::uint8_t { far, near, beyond };

template <class Real>
struct HexStrain {
  const HexRun* runs;
  const std::uint8_t* acts;  // of each run, 0: all around it sleeps
  const Real* u[3];          // displacement [m]                                               (n_cells)
  const Real* stretch;       // TensionLimit of a cell; 0: none that is whole and may break   (n_cells)
  const Real* tension;       //                                                                (n_cells)
  Index up_y, up_z;
  Real per_4h[3];   // [1/m]
  Real of_volume;   // (lambda + mu) / mu
  Strained* found;  // of each run
  bool only_near;   // leaves out the runs that were far when last looked at
};

struct HexStrainKind {};  // there is one

/// Looks at the runs [first, last).
template <class Real>
using HexStrainKernel = void (*)(const HexStrain<Real>&, Index first_run, Index last_run);

namespace sse2 {
template <class Real>
HexStrainKernel<Real> hex_strain_kernel(HexStrainKind kind);
}
namespace avx2 {
template <class Real>
HexStrainKernel<Real> hex_strain_kernel(HexStrainKind kind);
}
namespace avx512 {
template <class Real>
HexStrainKernel<Real> hex_strain_kernel(HexStrainKind kind);
}

/// Of the widest vectors that this machine has.
template <class Real>
HexStrainKernel<Real> hex_strain_kernel_here() {
  return kernel_for(instruction_set(), HexStrainKind{}, &sse2::hex_strain_kernel<Real>,
                    &avx2::hex_strain_kernel<Real>, &avx512::hex_strain_kernel<Real>);
}

}  // namespace palpate::physics
