#pragma once
// What a step did: time, calls and skips of every stage, and what the guard had to do. The guard reads the work of the tools
// back from it.

#include <array>
#include <chrono>
#include <cstdint>

namespace palpate::physics {

/// The stages of a frame, in order. The same words stand in summaries, documentation and traces.
enum class Stage : std::size_t {
  take_tools,
  find_contacts,
  element_forces,  // forces of all elements, yield, break and motion, in the same pass
  contact_forces,
  integrate,        // what is left to integrate after the pass: nothing but with backward_euler
  yield_and_break,  // in the same pass, without a time of its own; skipped where nothing breaks or is cut
  guard_finite,
  publish,
};
inline constexpr std::size_t n_stages = 8;
inline constexpr std::array<const char*, n_stages> stage_names{
    "take_tools", "find_contacts",   "element_forces", "contact_forces",
    "integrate",  "yield_and_break", "guard_finite",   "publish"};

struct StageTime {
  std::int64_t total_ns = 0;
  std::int64_t calls = 0;
  std::int64_t skipped = 0;
};

struct StepReport {
  std::array<StageTime, n_stages> stages{};
  std::int64_t frames = 0;
  std::int64_t steps = 0;
  std::int64_t nonfinite = 0;  // frames in which a number was not finite
  std::int64_t grown = 0;      // frames in which energy had grown beyond what was put in
  std::int64_t restored = 0;   // times the last good state was brought back
  std::int64_t halved = 0;     // times the step was halved
  std::int64_t unsolved = 0;   // steps of backward_euler whose equations were not solved to their tolerance
  std::int64_t newton_iterations = 0, cg_iterations = 0;  // of backward_euler, in all
  std::int64_t strokes = 0, undone = 0;                   // of blades, that have cut; and that were undone
  std::int64_t broken = 0;                                // elements, of themselves or cut
  double least_corner_J = 1;                              // of all bodies: see StepOutcome
  double tool_work = 0;                                   // done by tools on tissue [J]
  double cut = 0;                                         // toughness times the area that tools have cut [J]
  double cut_by_released = 0;                             // of that, what elements had held that were cut [J]
  double contact_lost = 0;   // kinetic energy, in collisions and at floor and walls [J]
  double tool_exchange = 0;  // sum of its magnitude over all steps [J]

  StageTime& operator[](Stage stage) { return stages[static_cast<std::size_t>(stage)]; }
};

/// Times one call of a stage.
class StageTimer {
 public:
  StageTimer(StepReport& report, Stage stage)
      : time_(report[stage]), start_(std::chrono::steady_clock::now()) {}
  ~StageTimer() {
    time_.total_ns +=
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start_)
            .count();
    ++time_.calls;
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  StageTime& time_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace palpate::physics
