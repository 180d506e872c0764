#define PALPATE_KERNEL avx512
#include "physics_node/step/fem/tet_kernel.inl"
