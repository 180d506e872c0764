#pragma once
// Which of the three builds of a kernel a machine gets.

#include "physics_node/step/lattice/element_context.h"

namespace palpate::physics {

/// What the build for these instructions makes of `kind`.
template <class Kernel, class Kind>
Kernel kernel_for(InstructionSet set, Kind kind, Kernel (*sse2)(Kind), Kernel (*avx2)(Kind),
                  Kernel (*avx512)(Kind)) {
  switch (set) {
    case InstructionSet::avx512:
      return avx512(kind);
    case InstructionSet::avx2:
      return avx2(kind);
    case InstructionSet::sse2:
      break;
  }
  return sse2(kind);
}

}  // namespace palpate::physics
