#define PALPATE_KERNEL avx512
#include "physics_node/step/element_kernel.inl"
