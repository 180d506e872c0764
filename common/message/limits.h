#pragma once
// How much messages hold, what no number on the wire exceeds, and why a sample is rejected.

#include <array>
#include <cstdint>

namespace palpate {

using Array3 = std::array<double, 3>;
using Array4 = std::array<double, 4>;
using Array3f = std::array<float, 3>;

inline constexpr std::uint32_t max_tools = 8;
inline constexpr std::uint32_t max_bodies = 64;
inline constexpr std::uint32_t max_patch_facets = 16;
// Samples of the hand that ToolState has beside the newest. Why: with them it is one frame of Ethernet, and 64 ms cover physics at 20 Hz.
inline constexpr std::uint32_t max_told_samples = 64;
inline constexpr std::uint32_t max_tissue_modes = 9, max_tissue_branches = 5;
inline constexpr std::uint32_t max_surface_vertices = 2048;  // in one BodySurface chunk
inline constexpr std::uint32_t max_surface_facets = 2048;    // in one BodySurface chunk
inline constexpr std::uint32_t max_surface_chunks = 16384;   // of one body: 33 million vertices
// In one page of a SurfaceChange. Why: 1,348 bytes with what RTPS, UDP and IP add fit into one frame of Ethernet. A cut through the
// brain of scenes/ changes 1 to 220 facets a picture and shows a seventh as many new vertices.
inline constexpr std::uint32_t max_change_vertices = 12;
inline constexpr std::uint32_t max_change_facets = 48;
inline constexpr std::uint32_t max_change_pages = 16384;   // of one surface
inline constexpr std::uint32_t max_block_vertices = 2048;  // in one VertexBlock
inline constexpr std::uint32_t max_trace_samples = 64;
inline constexpr std::uint32_t histogram_bins = 24;  // bin b counts [2^b, 2^(b+1)) microseconds; bin 0 also 0
inline constexpr std::uint32_t n_tallies = 8;        // counters of rejected samples, by RejectReason

// What no number on the wire exceeds, whoever sends it. Why: a changed bit makes finite numbers, too, of which a time of
// 1e300 s is one, and what is not bounded where it enters becomes an index or a size somewhere.
inline constexpr double longest_time = 1e8;      // three years [s]
inline constexpr double farthest_hand = 1e3;     // a hand, what it touches, and how fast they are [m], [m/s]
inline constexpr double farthest_vertex = 1e6;   // what has flown off [m]
inline constexpr double fastest_turn = 1e6;      // [rad/s]
inline constexpr double strongest_hand = 1e3;    // that a device applies [N], [N m]
inline constexpr double strongest_tissue = 1e6;  // [N], [N m]
// Why: a tenth of a gram on what stands for "does not give", 1e9 N/m; what is beyond is no tissue.
inline constexpr double stiffest_mode = 1e13;     // omega^2 [1/s^2]
inline constexpr double most_mode_damping = 1e7;  // c [1/s]
inline constexpr double largest_shape = 1e3;      // of a mode, of a microgram [1 / sqrt(kg)]
inline constexpr double largest_state = 1e6;      // of a mode [m sqrt(kg)], and per second
inline constexpr double most_compliance = 1;      // beside modes [m/N]
inline constexpr double most_flow = 1e6;          // of what relaxes in it, over what stays
inline constexpr double most_growth = 1e12;       // of a contact: a ball of 1 m on 1 Pa and 0.1 mm [1/N]
inline constexpr double rigid_stiffness = 1e9;    // stands for "does not give" [N/m]
inline constexpr double most_energy = 1e6;        // [J]
inline constexpr double largest_field = 1e12;     // that colours show, strain or stress [Pa]
inline constexpr double largest_value = 1e9;      // of a command or a rate, in its unit
inline constexpr std::int64_t latest_stamp = std::int64_t{1} << 61;  // either side of zero [ns]

/// Why a sample was rejected; index into NodeStatus::rejected.
enum class RejectReason : std::uint32_t {
  version,
  count,
  unknown_id,
  not_finite,
  not_unit,
  out_of_range,
  text,
  other
};

}  // namespace palpate
