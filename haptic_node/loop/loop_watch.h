#pragma once
// What the slow thread makes of the real-time thread: how many ticks it truly does, whether it stands still, and in whose
// driver. Each kind of lateness is said once, with its own words.

#include <cstdint>
#include <string>

#include "haptic_node/loop/rate_meter.h"
#include "haptic_node/loop/realtime_loop.h"
#include "haptic_node/loop/said.h"

namespace palpate::haptic {

class LoopWatch {
 public:
  /// Below this share of its rate a loop is called slow. Why: forces are tuned for one tick of delay, and a tenth of the ticks
  /// missing is felt as a softer wall before anything else shows it.
  static constexpr double slow = 0.9;

  /// @param loop, said  outlive this. @param rate_Hz  that is wanted
  LoopWatch(const RealtimeLoop& loop, double rate_Hz, Said& said)
      : loop_(loop), said_(said), wanted_Hz_(rate_Hz) {}

  /// Every few milliseconds.
  void look(std::int64_t now);
  /// With each status. @return ticks a second, over the last second of wall clock
  double measure(std::int64_t now);

  /// How long the loop has been in the driver of `tool` without a tick [ns]; 0: it is elsewhere, or has just begun.
  std::int64_t in_driver_ns(int tool, std::int64_t now) const noexcept;

  /// "" or what a person should know of it now: "66 of 1000 ticks a second".
  std::string note() const;

 private:
  const RealtimeLoop& loop_;
  Said& said_;
  double wanted_Hz_;
  RateMeter meter_;
  std::uint64_t ticks_ = 0;
  std::int64_t tick_ns_ = 0, began_ns_ = 0;
  double rate_Hz_ = 0;
  bool slow_ = false, said_slow_ = false, said_stop_ = false;
};

}  // namespace palpate::haptic
