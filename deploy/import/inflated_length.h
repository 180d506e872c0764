#pragma once
// How much does a zlib stream hold? For cells whose library does not say when inflating fails.

#include <cstdint>
#include <optional>
#include <string>

namespace palpate {

/// Inflates `bytes` of the file from `offset` on, and throws the result away.
/// @return its length; nothing if the stream is damaged or does not end
std::optional<std::uint64_t> inflated_length(const std::string& file, std::uint64_t offset,
                                             std::uint64_t bytes);

}  // namespace palpate
