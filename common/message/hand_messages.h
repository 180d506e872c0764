#pragma once
// What the hand says: where it is and what it feels; and where a person points with a mouse.

#include <array>
#include <cstdint>

#include "common/message/limits.h"
#include "common/message/promise.h"

namespace palpate {

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
  Array3 force_now{};   // the same as it is in this tick; where motion presses tissue, of this sample [N]
  Array3 torque_now{};  // about the tip, as it is in this tick [N m]
  std::uint64_t contact_set = 0;  // contact_set of the patch that this force was computed from; 0 none
  std::uint32_t buttons = 0;      // bit i: button i pressed
  std::uint32_t engaged = 0;      // 1: the hand is armed and its forces count
  // Of a hand whose motion presses tissue; else 0.
  std::uint64_t sample = 0;    // number of the sample at p_WT; they come at the rate of the device
  double stiffness = 0;        // of the spring between hand and tissue, K [N/m]
  double damping = 0;          // B [N s/m]
  double force_limit = 0;      // the hand feels no more [N]
  std::uint32_t n_before = 0;  // <= max_told_samples
  std::array<Array3f, max_told_samples> before{};  // the samples before it, newest first, from p_WT [m]

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(tool), below(max_tools));
    visit(PALPATE_FIELD(tick), any);
    visit(PALPATE_FIELD(stamp_ns), stamp);
    visit(PALPATE_FIELD(p_WT), within(farthest_hand));
    visit(PALPATE_FIELD(q_WT), unit);
    visit(PALPATE_FIELD(v_WT), within(farthest_hand));
    visit(PALPATE_FIELD(w_WT), within(fastest_turn));
    visit(PALPATE_FIELD(proxy), within(farthest_hand));
    visit(PALPATE_FIELD(force_on_hand), within(strongest_hand));
    visit(PALPATE_FIELD(force_now), within(strongest_hand));
    visit(PALPATE_FIELD(torque_now), within(strongest_hand));
    visit(PALPATE_FIELD(contact_set), any);
    visit(PALPATE_FIELD(buttons), any);
    visit(PALPATE_FIELD(engaged), flag);
    visit(PALPATE_FIELD(sample), any);
    visit(PALPATE_FIELD(stiffness), up_to(rigid_stiffness));
    visit(PALPATE_FIELD(damping), up_to(rigid_stiffness));
    visit(PALPATE_FIELD(force_limit), up_to(strongest_hand));
    visit(PALPATE_FIELD(n_before), count(max_told_samples));
    visit.first(PALPATE_FIELD(before), PALPATE_FIELD(n_before), within(farthest_hand));
  }
  friend bool operator==(const ToolState&, const ToolState&) = default;
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

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(tick), any);
    visit(PALPATE_FIELD(t), up_to(longest_time));
    visit(PALPATE_FIELD(p), within(farthest_hand));
    visit(PALPATE_FIELD(proxy), within(farthest_hand));
    visit(PALPATE_FIELD(force), within(strongest_hand));
    visit(PALPATE_FIELD(torque), within(strongest_hand));
    visit(PALPATE_FIELD(energy), within(most_energy));
  }
  friend bool operator==(const TraceSample&, const TraceSample&) = default;
};
struct HapticTrace {
  std::uint32_t tool = 0;
  std::uint64_t batch = 0;
  std::uint32_t n_samples = 0;  // <= max_trace_samples
  std::array<TraceSample, max_trace_samples> samples{};

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(tool), below(max_tools));
    visit(PALPATE_FIELD(batch), any);
    visit(PALPATE_FIELD(n_samples), count(max_trace_samples));
    visit.each(PALPATE_FIELD(samples), PALPATE_FIELD(n_samples), of_type<TraceSample>);
    visit.rule("samples.tick", RejectReason::other, [](const auto& m) {
      return is_growing(m.samples, m.n_samples, [](const auto& sample) { return sample.tick; });
    });
  }
  friend bool operator==(const HapticTrace&, const HapticTrace&) = default;
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

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(tool), below(max_tools));
    visit(PALPATE_FIELD(tick), any);
    visit(PALPATE_FIELD(stamp_ns), stamp);
    visit(PALPATE_FIELD(p_W), within(farthest_hand));
    visit(PALPATE_FIELD(q_W), unit);
    visit(PALPATE_FIELD(buttons), any);
    visit(PALPATE_FIELD(held), flag);
  }
  friend bool operator==(const Pointer&, const Pointer&) = default;
};

}  // namespace palpate
