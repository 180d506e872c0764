#define PALPATE_KERNEL sse2
#include "physics_node/step/multigrid/level_kernel.inl"
