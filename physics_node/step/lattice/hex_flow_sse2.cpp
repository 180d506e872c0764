#define PALPATE_KERNEL sse2
#include "physics_node/step/lattice/hex_flow.inl"
