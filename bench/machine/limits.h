#pragma once
// What this machine can do at most: the roof over every kernel. Measured, not looked up.

#include <cstddef>

namespace palpate::bench {

/// Bytes moved per second by the triad a = b + s c over three arrays that hold `bytes` in all; the best of several
/// passes. Counts two reads and one write; the read that a write may cost besides is not counted.
/// Source: McCalpin 1995, STREAM.
double triad_bytes_per_s(std::size_t bytes, int threads);

/// Floating-point operations per second of independent fused multiply-adds in the widest vectors of this machine, on one
/// core; two operations each.
double fma_flops_per_s(bool single);

/// The same of as many multiplications as additions, not fused: the roof of what is not written as fma.
double multiply_add_flops_per_s(bool single);

}  // namespace palpate::bench
