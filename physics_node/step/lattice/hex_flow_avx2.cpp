#define PALPATE_KERNEL avx2
#include "physics_node/step/lattice/hex_flow.inl"
