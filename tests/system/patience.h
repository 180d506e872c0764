#pragma once
// How long a test waits for what must come at all, on a machine that others use. A bound for a broken run, not a measurement:
// what the product promises in seconds is judged from its own stamps, or as the least of several tries.

#include <chrono>

namespace palpate::test {

inline constexpr std::chrono::seconds patience{100};
inline constexpr int tries = 5;  // other programs make a try longer, never shorter

}  // namespace palpate::test
