#pragma GCC diagnostic ignored "-Wuninitialized"  // of the intrinsics header
#define PALPATE_KERNEL avx512
#include "physics_node/step/lattice/hex_flow.inl"
