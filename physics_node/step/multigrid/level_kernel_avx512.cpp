#define PALPATE_KERNEL avx512
#include "physics_node/step/multigrid/level_kernel.inl"
