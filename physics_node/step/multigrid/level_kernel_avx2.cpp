#define PALPATE_KERNEL avx2
#include "physics_node/step/multigrid/level_kernel.inl"
