#pragma once
// What people say to nodes, and nodes of themselves.

#include <array>
#include <cstdint>

#include "common/message/limits.h"
#include "common/message/promise.h"

namespace palpate {

enum class CommandKind : std::uint32_t {
  pause,
  resume,
  reset,
  threshold,
  record,
  material,
  device,
  stop,
  section,
  colour,
  inside
};
inline constexpr std::uint32_t n_command_kinds = 11;

/// render, palpate -> physics, haptic.
struct Command {
  std::uint64_t id = 0;  // grows per writer; a repeated id is ignored
  CommandKind kind = CommandKind::pause;
  // pause: frames to go on by first, 0 or more; threshold: intensity; record: 0 or 1; device: 1 ends a fault;
  // section: where it cuts the axis [m]; inside: intensity
  double value = 0;
  // material, tool whose device it is about, axis of the section: section_name(), what colours are to say:
  // name_of(ColourKind), or whether what lies inside is shown: inside_name()
  std::array<char, 64> name{};

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(id), any);
    visit(PALPATE_FIELD(kind), one_of(n_command_kinds, RejectReason::unknown_id));
    visit(PALPATE_FIELD(value), within(largest_value));
    visit(PALPATE_FIELD(name), text);
  }
  friend bool operator==(const Command&, const Command&) = default;
};

enum class NodeKind : std::uint32_t { physics, haptic, render, supervisor };
inline constexpr std::uint32_t n_node_kinds = 4;
enum class NodePhase : std::uint32_t { loading, ready, running, stopping, failed };
inline constexpr std::uint32_t n_node_phases = 5;

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

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(node), one_of(n_node_kinds, RejectReason::unknown_id));
    visit(PALPATE_FIELD(phase), one_of(n_node_phases, RejectReason::out_of_range));
    visit(PALPATE_FIELD(pid), any);
    visit(PALPATE_FIELD(scene_checksum), any);
    visit(PALPATE_FIELD(t), up_to(longest_time));
    visit(PALPATE_FIELD(rate_Hz), up_to(largest_value));
    visit(PALPATE_FIELD(real_time_factor), up_to(largest_value));
    visit(PALPATE_FIELD(loop_age_ms_p50), up_to(largest_value));
    visit(PALPATE_FIELD(ticks), any);
    visit(PALPATE_FIELD(late), any);
    visit(PALPATE_FIELD(samples_received), any);
    visit(PALPATE_FIELD(samples_lost), any);
    visit(PALPATE_FIELD(rejected), any);
    visit(PALPATE_FIELD(foreign), any);
    visit(PALPATE_FIELD(warnings), any);
    visit(PALPATE_FIELD(energy_J), within(most_energy));
    visit(PALPATE_FIELD(surplus_J), within(most_energy));
    visit(PALPATE_FIELD(stale_events), any);
    visit(PALPATE_FIELD(safe_events), any);
    visit(PALPATE_FIELD(faults), any);
    visit(PALPATE_FIELD(lateness), any);
    visit(PALPATE_FIELD(note), text);
    visit(PALPATE_FIELD(refused), text);
  }
  friend bool operator==(const NodeStatus&, const NodeStatus&) = default;
};

}  // namespace palpate
