#pragma once
// An import says what it will cost before it takes memory, and the kernel holds it to that: a damaged header
// that makes a library ask for gigabytes gets none. Limits are of this process (RLIMIT_DATA), so the child of
// in_child.h sets them, and they need no names to be passed on.

#include <cstdint>
#include <string>

namespace palpate {

/// Least that an import can do with: its programs, libraries and buffers [bytes].
inline constexpr double least_memory = 0.3e9;

/// Bytes a cell of a volume that is held as floats, and written as whole numbers.
inline constexpr double written_bytes = 6;

/// From now on this process gets no more than `limit` bytes, and until it declares cells only what reading
/// headers takes.
/// @param file_bytes  length of what is read: libraries hold a file as it is
void begin_memory(std::uint64_t limit, std::uint64_t file_bytes) noexcept;

/// Says what comes next, and gets it, on top of what is in use now.
/// @param where  begins the complaint: the file's name, or an option
/// @param bytes_a_cell  at the worst moment until the volume is written
/// @throws InputError: more than the limit; the line has cells, cost and limit
void declare_cells(const std::string& where, std::uint64_t cells, double bytes_a_cell);

/// The same without getting it: for what comes later.
void check_cost(const std::string& where, std::uint64_t cells, double bytes_a_cell);

}  // namespace palpate
