#pragma once
// What the three nodes tell each other, as plain SI structs. common/wire carries them over DDS and rejects
// whole any sample that breaks the promises written here. idl/README.md has writers, readers, rates and QoS.
//
// World frame everywhere, metres, newtons, seconds. Quaternions are (w, x, y, z). Text is zero-terminated.
// All structs are trivially copyable, so that they pass through lock-free buffers and shared memory.

#include <array>
#include <cstdint>

namespace palpate {

using Array3 = std::array<double, 3>;
using Array4 = std::array<double, 4>;
using Array3f = std::array<float, 3>;

inline constexpr std::uint32_t wire_version = 6;  // a reader rejects every other version

inline constexpr std::uint32_t max_tools = 8;
inline constexpr std::uint32_t max_bodies = 64;
inline constexpr std::uint32_t max_patch_facets = 16;
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
inline constexpr double most_energy = 1e6;       // [J]
inline constexpr double largest_value = 1e9;     // of a command or a rate, in its unit
inline constexpr std::int64_t latest_stamp = std::int64_t{1} << 61;  // either side of zero [ns]

/// haptic -> physics. Where the hand is, and the force that it feels now.
struct ToolState {
  std::uint32_t tool = 0;     // index of [[tool]] in the scene, < max_tools
  std::uint64_t tick = 0;     // counts ticks of the haptic loop; the newest wins
  std::int64_t stamp_ns = 0;  // CLOCK_MONOTONIC of the writer: only differences on one machine mean anything
  Array3 p_WT{};              // tool tip [m]
  Array4 q_WT{1, 0, 0, 0};    // attitude, unit
  Array3 v_WT{};              // velocity of the tip [m/s]
  Array3 w_WT{};              // angular velocity [rad/s]
  Array3 proxy{};             // where the proxy rests: the tip if nothing is touched [m]
  Array3
      force_on_hand{};  // force that the device applies to the hand, low-passed at 2 Hz; HapticTrace has it as it is [N]
  Array3 force_now{};             // the same as it is in this tick [N]
  Array3 torque_now{};            // about the tip, as it is in this tick [N m]
  std::uint64_t contact_set = 0;  // contact_set of the patch that this force was computed from; 0 none
  std::uint32_t buttons = 0;      // bit i: button i pressed
  std::uint32_t engaged = 0;      // 1: the hand is armed and its forces count
};

/// One facet of the tissue near a tool, as a Norton-equivalent plane: where the plane would be without
/// contact force, and how stiffly the tissue behind it answers.
struct PatchFacet {
  std::array<Array3, 3> corners{};  // current positions [m]
  Array3 point{};                   // a point of the plane at zero contact force [m]
  Array3 normal{};                  // out of the tissue, unit
  Array3 velocity{};                // of the plane [m/s]
  double stiffness = 0;    // of the tissue behind the plane [N/m], > 0; rigid scenery: rigid_stiffness
  double damping = 0;      // [N s/m], >= 0
  std::uint32_t body = 0;  // index of [[body]], < max_bodies
};
inline constexpr double rigid_stiffness = 1e9;  // stands for "does not give"

/// physics -> haptic. The facets that a tool may touch before the next patch. Facet 0 is the nearest one.
struct ContactPatch {
  std::uint32_t tool = 0;
  std::uint64_t tick = 0;         // counts physics frames
  std::int64_t stamp_ns = 0;      // writer's CLOCK_MONOTONIC
  std::uint64_t answers = 0;      // ToolState.tick that this answers; 0: none yet
  std::int64_t answers_ns = 0;    // ToolState.stamp_ns of that tick, echoed: loop age = now - answers_ns
  std::uint64_t contact_set = 0;  // changes when the set of facets changes
  std::uint32_t n_facets = 0;     // <= max_patch_facets; 0: free space
  std::array<PatchFacet, max_patch_facets> facets{};
};

/// physics -> haptic, render. What the tissue does to a tool, and how that changes with the pose of the hand: with M_T the
/// moment about tip,   (F, M_T)(p, q) = (F, M_T) - stiffness (p - p_WT, rotation vector from q_WT to q)
/// Where physics knows the surface beside the tool, touched or not, the hand feels that instead, as a spring that pushes only:
///   stiffness ((stretch normal, 0) - (p - p_WT, rotation vector from q_WT to q))
/// which does not follow the tissue's swinging as force and moment do.
struct ToolWrench {
  std::uint32_t tool = 0;
  std::uint64_t tick = 0;
  std::int64_t stamp_ns = 0;
  std::uint64_t answers = 0;  // as in ContactPatch
  std::int64_t answers_ns = 0;
  double t = 0;             // simulated time [s]
  Array3 p_WT{};            // pose of the hand to which force and moment belong: its tip [m]
  Array4 q_WT{1, 0, 0, 0};  // attitude, unit
  Array3 force{};           // on the tool [N]
  Array3 moment{};          // on the tool, about set_point [N m]
  Array3 set_point{};       // [m]
  Array3 tip{};  // of the tool, which M_T is about [m]; elsewhere than p_WT if the hand took it there
  std::array<double, 36>
      stiffness{};               // local 6x6, symmetric, row major [N/m, N, N m/rad]; zero: not computed
  Array3 normal{};               // out of the tissue, unit; zero: no surface is known
  double stretch = 0;            // of the spring at p_WT, q_WT; below 0: the way that is left to contact [m]
  std::uint32_t n_contacts = 0;  // colliding masses
};

/// physics -> render. One chunk of what is visible of a body: vertices with their positions at publication
/// and four-cornered facets. A set is complete when all n_chunks of one revision have come. A triangle repeats its last
/// corner; a facet without an area is an element (a, b, b, b) or a mass (a, a, a, a) that belongs to no other facet.
struct BodySurface {
  std::uint32_t body = 0;
  std::uint32_t revision =
      0;                    // numbers vertices and facets; grows with every surface sent whole; starts at 1
  std::uint32_t chunk = 0;  // < n_chunks <= max_surface_chunks
  std::uint32_t n_chunks = 1;
  std::uint32_t total_vertices = 0;
  std::uint32_t total_facets = 0;
  std::uint32_t facets_hidden = 0;  // of the whole body: facets between two filled cells, not sent
  std::uint32_t rigid = 0;          // 1: scenery, no VertexBlock will follow
  std::uint32_t first_vertex = 0;   // of this chunk
  std::uint32_t n_vertices = 0;     // <= max_surface_vertices
  std::uint32_t first_facet = 0;
  std::uint32_t n_facets = 0;                                              // <= max_surface_facets
  std::array<Array3f, max_surface_vertices> position{};                    // [m]
  std::array<std::array<std::uint32_t, 4>, max_surface_facets> corners{};  // < total_vertices
  std::array<std::uint32_t, max_surface_facets> rgba{};                    // 0xAABBGGRR
};

/// physics -> render. What breaks, cuts and new thresholds have changed in a BodySurface, as a list that only grows: a page is
/// written again until it is full, a full one never. Pages from 0 on therefore change the surface to what it is, for a reader
/// that has seen all as for one that comes late, and in whatever order they arrive. The list is complete up to some change when all
/// pages up to `total_changes` and `total_vertices` of its page are there. New vertices come behind all others and keep their numbers.
struct FacetChange {
  std::uint32_t facet = 0;                 // one that is there, or the next one behind the last
  std::array<std::uint32_t, 4> corners{};  // as in BodySurface
  std::uint32_t rgba = 0;
};
struct SurfaceChange {
  std::uint32_t body = 0;
  std::uint32_t revision = 0;  // of the BodySurface that is changed
  std::uint32_t page =
      0;  // < max_change_pages; a page begins where the one before it was full of vertices or facets
  std::uint32_t change = 0;  // grows with every new surface of this revision; starts at 1
  // All after this change.
  std::uint32_t total_vertices = 0;
  std::uint32_t total_facets = 0;   // what is behind them is gone
  std::uint32_t total_changes = 0;  // of facets, in all pages
  std::uint32_t facets_hidden = 0;
  // What is in this page.
  std::uint32_t first_vertex = 0;
  std::uint32_t n_vertices = 0;                         // <= max_change_vertices
  std::uint32_t first_change = 0;                       // of facets, counted through all pages
  std::uint32_t n_changes = 0;                          // <= max_change_facets
  std::array<Array3f, max_change_vertices> position{};  // when they were new [m]
  std::array<FacetChange, max_change_facets> facets{};  // one after the other
};

/// State of a vertex.
inline constexpr std::uint8_t vertex_yielded = 1;  // an element at this vertex has yielded
inline constexpr std::uint8_t vertex_broken = 2;   // an element at this vertex has broken
inline constexpr std::uint8_t vertex_share_one =
    4;  // the other six bits: how many 63rds of its live elements have yielded,
        // which is how dark it is drawn; 0 unless vertex_yielded

/// physics -> render. Where some vertices of a BodySurface revision and of its changes are now. Only blocks that changed are sent.
struct VertexBlock {
  std::uint32_t body = 0;
  std::uint32_t revision = 0;  // of the BodySurface that numbers these vertices
  std::uint32_t block = 0;     // first_vertex / max_block_vertices
  std::uint64_t tick = 0;
  double t = 0;  // simulated time [s]
  std::uint32_t first_vertex = 0;
  std::uint32_t n_vertices = 0;                        // <= max_block_vertices
  std::array<Array3f, max_block_vertices> position{};  // [m]
  std::array<std::uint8_t, max_block_vertices> flags{};
};

/// haptic -> render, record. 1 kHz samples, in batches, none left out.
struct TraceSample {
  std::uint64_t tick = 0;
  double t = 0;       // device time since the loop started [s]
  Array3 p{};         // tip [m]
  Array3 proxy{};     // [m]
  Array3 force{};     // on the hand [N]
  Array3 torque{};    // on the hand, about the tip [N m]
  double energy = 0;  // given to the hand so far through the device port [J]
};
struct HapticTrace {
  std::uint32_t tool = 0;
  std::uint64_t batch = 0;
  std::uint32_t n_samples = 0;  // <= max_trace_samples
  std::array<TraceSample, max_trace_samples> samples{};
};

/// render -> haptic. Where a person points with mouse and keys: the tip of a tool in the world, for the driver `mouse`.
struct Pointer {
  std::uint32_t tool = 0;
  std::uint64_t tick = 0;     // counts samples
  std::int64_t stamp_ns = 0;  // writer's CLOCK_MONOTONIC
  Array3 p_W{};               // [m]
  Array4 q_W{1, 0, 0, 0};     // attitude of the tool, unit
  std::uint32_t buttons = 0;  // bit i: button i pressed
  std::uint32_t held = 0;     // 1: the person moves the tool; 0: let go
};

enum class CommandKind : std::uint32_t { pause, resume, reset, threshold, record, material, device, stop };
inline constexpr std::uint32_t n_command_kinds = 8;

/// render, palpate -> physics, haptic.
struct Command {
  std::uint64_t id = 0;  // grows per writer; a repeated id is ignored
  CommandKind kind = CommandKind::pause;
  double value = 0;             // threshold: intensity; record: 0 or 1; device: 1 ends a fault
  std::array<char, 64> name{};  // material, or tool whose device it is about
};

enum class NodeKind : std::uint32_t { physics, haptic, render, supervisor };
inline constexpr std::uint32_t n_node_kinds = 4;
enum class NodePhase : std::uint32_t { loading, ready, running, stopping, failed };
inline constexpr std::uint32_t n_node_phases = 5;

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

/// all -> anyone, 2 to 10 Hz.
struct NodeStatus {
  NodeKind node = NodeKind::physics;
  NodePhase phase = NodePhase::loading;
  std::uint32_t pid = 0;
  std::uint64_t scene_checksum = 0;  // of the scene text and the settings given on the command line
  double t = 0;                      // simulated (physics), device (haptic) or drawn (render) time [s]
  double rate_Hz = 0;                // frames, ticks or pictures a second, over the last status period
  double real_time_factor = 0;       // simulated per wall time, over the last status period
  double loop_age_ms_p50 = 0;        // haptic only: hand tick to the patch that answers it
  std::uint64_t ticks = 0;
  std::uint64_t late = 0;  // ticks that missed their deadline
  std::uint64_t samples_received = 0;
  std::uint64_t samples_lost = 0;  // gaps in the writers' ticks
  std::array<std::uint64_t, n_tallies> rejected{};
  std::uint64_t foreign = 0;  // samples of processes that may not speak here, or not now: never looked at
  std::uint32_t warnings = 0;
  double energy_J = 0;   // haptic only: given to the hand so far, of the tool that got most
  double surplus_J = 0;  // haptic only: of that, made out of nothing, now; above 0.1 mJ is not passive
  std::uint32_t stale_events = 0, safe_events = 0,
                faults = 0;                              // haptic only: since the start, over all tools
  std::array<std::uint64_t, histogram_bins> lateness{};  // wake-up lateness since the start
  std::array<char, 128> note{};                          // what a person should know now
  std::array<char, 128>
      refused{};  // the first sample that was rejected or foreign, and why; empty: none so far
};

}  // namespace palpate
