#define PALPATE_KERNEL sse2
#include "physics_node/step/element_kernel.inl"
