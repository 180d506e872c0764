#pragma once
// What Linux tells of another process of this machine.

#include <cstdint>

namespace palpate {

/// True if there is no such process any more, or if it only waits to be buried. A process that stands still lives.
bool has_ended(std::uint32_t pid);

/// True if `pid` was started before `other`; of two that began in the same 10 ms, the one with the smaller number. False if
/// either cannot be looked at.
bool started_before(std::uint32_t pid, std::uint32_t other);

}  // namespace palpate
