#pragma once
// What surfaces have cost on the wire, without what DDS adds.

#include <cstdint>
#include <nlohmann/json.hpp>

namespace palpate::physics {

struct SurfaceBytes {
  std::uint64_t first = 0;  // of the first surface of every body
  std::uint64_t sent = 0;   // since, by breaks, thresholds and resets
  std::uint64_t whole = 0;  // what the same would have been if each new surface had been sent whole
};

/// For summary.json.
inline nlohmann::json surface_bytes_report(const SurfaceBytes& bytes) {
  return {{"surface_bytes", {{"first", bytes.first}, {"sent", bytes.sent}, {"whole", bytes.whole}}}};
}

}  // namespace palpate::physics
