#include "haptic_node/loop/realtime_loop.h"

#include <algorithm>
#include <chrono>

#include "common/time/clock.h"
#include "common/time/ticker.h"
#include "haptic_node/loop/realtime.h"

namespace palpate::haptic {
namespace {

constexpr std::uint64_t publish_every = 50;  // ticks
constexpr std::int64_t finish_within_ns = 100'000'000;

}  // namespace

void RealtimeLoop::start() {
  thread_ = std::thread([this] { run(); });
  watchdog_ = std::thread([this] { watch(); });
}

void RealtimeLoop::finish() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
  if (watchdog_.joinable()) watchdog_.join();
}

bool RealtimeLoop::all_stopped() const noexcept {
  return std::all_of(channels_.begin(), channels_.end(),
                     [](const auto& channel) { return channel->session.stopped(); });
}

void RealtimeLoop::tick_tools(std::int64_t woke_ns) noexcept {
  for (const auto& channel : channels_) {
    bool is_new = false;
    const ContactPatch* patch = channel->patches.newest(&is_new);
    if (is_new && patch->answers_ns > 0)
      stats_.loop_age.add(1e3 * seconds_from_ns(woke_ns - patch->answers_ns));
    channel->session.tick(patch, channel->wrenches.newest());
    channel->states.write(channel->session.tool_state());
    if (!channel->trace.push(channel->session.trace())) channel->trace_lost.fetch_add(1);
    channel->reports.write(
        {channel->session.state(), channel->session.counts(), channel->session.first_run_ns()});
  }
}

void RealtimeLoop::run() noexcept {
  enter_realtime(priority);
  for (const auto& channel : channels_) channel->session.attach();
  Ticker ticker(rate_Hz_);
  stats_.start_ns = now_ns();
  std::int64_t stop_ns = 0;
  // 1. wait  2. tick every tool  3. measure
  for (;;) {
    const Ticker::Wake wake = ticker.wait();
    if (stop_.load(std::memory_order_relaxed) && stop_ns == 0) {
      stop_ns = wake.woke_ns;
      for (const auto& channel : channels_) channel->session.begin_stop();
    }
    tick_tools(wake.woke_ns);
    heartbeat_.fetch_add(1, std::memory_order_release);

    if (stats_.last_ns > 0) stats_.period.add(1e-3 * static_cast<double>(wake.woke_ns - stats_.last_ns));
    stats_.last_ns = wake.woke_ns;
    stats_.ticks += 1;
    stats_.skipped += wake.skipped;
    stats_.lateness[octave_bin((wake.woke_ns - wake.due_ns) / 1000, histogram_bins)] += 1;
    stats_.watchdog_stops = watchdog_stops_.load(std::memory_order_relaxed);
    stats_.compute.add(1e-3 * static_cast<double>(now_ns() - wake.woke_ns));
    if (stats_.ticks % publish_every == 0) published_.write(stats_);
    if (stop_ns > 0 && (all_stopped() || wake.woke_ns - stop_ns > finish_within_ns)) break;
  }
  published_.write(stats_);
  done_.store(true);
}

void RealtimeLoop::watch() noexcept {
  enter_realtime(watchdog_priority);
  std::uint64_t seen = 0;
  std::int64_t seen_ns = now_ns();
  bool stopped = false;
  while (!done_.load()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::uint64_t beat = heartbeat_.load(std::memory_order_acquire);
    if (beat == 0 || beat != seen) {
      seen = beat;
      seen_ns = now_ns();
      stopped = false;
    } else if (!stopped && now_ns() - seen_ns > watchdog_ns) {
      for (const auto& channel : channels_) channel->session.stop_motors();
      watchdog_stops_.fetch_add(1);
      stopped = true;
    }
  }
}

}  // namespace palpate::haptic
