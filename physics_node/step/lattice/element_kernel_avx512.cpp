#define PALPATE_KERNEL avx512
#include "physics_node/step/lattice/element_kernel.inl"
