#define PALPATE_KERNEL avx2
#include "physics_node/step/fem/fast_kernel.inl"
