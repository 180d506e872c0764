#include "haptic_node/loop/loop_watch.h"

#include <fmt/format.h>

namespace palpate::haptic {
namespace {

constexpr std::int64_t warm_up_ns = 2'000'000'000;  // of the loop, before its rate is judged

}  // namespace

void LoopWatch::look(std::int64_t now) {
  const std::uint64_t ticks = loop_.ticks_done();
  if (tick_ns_ == 0 || ticks != ticks_) tick_ns_ = now;
  ticks_ = ticks;
  if (loop_.watchdog_stops() == 0 || said_stop_) return;
  said_stop_ = true;
  said_.warn(fmt::format(
      "no tick for more than {} ms: motors were switched off until the next one (said once, counted as "
      "watchdog_stops)",
      RealtimeLoop::watchdog_ns / 1'000'000));
}

double LoopWatch::measure(std::int64_t now) {
  if (began_ns_ == 0) began_ns_ = now;
  rate_Hz_ = meter_.take(loop_.ticks_done(), now);
  slow_ = now - began_ns_ > warm_up_ns && rate_Hz_ < slow * wanted_Hz_;
  if (slow_ && !said_slow_) {
    said_slow_ = true;
    said_.warn(fmt::format(
        "{:.0f} of {:.0f} ticks a second: forces come late; ease the load of this machine, or see why a "
        "driver is slow (said once)",
        rate_Hz_, wanted_Hz_));
  }
  return rate_Hz_;
}

std::int64_t LoopWatch::in_driver_ns(int tool, std::int64_t now) const noexcept {
  return loop_.in_tool() == tool && loop_.ticks_done() == ticks_ ? now - tick_ns_ : 0;
}

std::string LoopWatch::note() const {
  return slow_ ? fmt::format("{:.0f} of {:.0f} ticks a second", rate_Hz_, wanted_Hz_) : std::string();
}

}  // namespace palpate::haptic
