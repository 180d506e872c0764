#pragma once
// How much memory is there for us?

#include <cstdint>

namespace palpate {

/// What this machine has, or what the control group of this process leaves it if that is less [bytes].
std::uint64_t machine_memory() noexcept;

}  // namespace palpate
