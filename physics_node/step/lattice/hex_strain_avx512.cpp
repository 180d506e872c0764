#define PALPATE_KERNEL avx512
#include "physics_node/step/lattice/hex_strain.inl"
