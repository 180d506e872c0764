#define PALPATE_KERNEL sse2
#include "physics_node/step/lattice/element_kernel.inl"
