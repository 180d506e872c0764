#define PALPATE_KERNEL sse2
#include "physics_node/step/fem/fast_kernel.inl"
