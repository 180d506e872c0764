#define PALPATE_KERNEL avx512
#include "physics_node/step/fem/fast_kernel.inl"
