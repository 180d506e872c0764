#define PALPATE_KERNEL avx2
#include "physics_node/step/element_kernel.inl"
