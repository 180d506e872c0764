#pragma once
// The real-time thread: ticks all tools at one rate, and its watchdog. Knows nothing of the wire.

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "common/exchange/triple_buffer.h"
#include "common/time/ticker.h"
#include "haptic_node/loop/loop_stats.h"
#include "haptic_node/loop/thread_usage.h"
#include "haptic_node/loop/tool_channel.h"

namespace palpate::haptic {

class RealtimeLoop {
 public:
  static constexpr int priority = 80;
  static constexpr int watchdog_priority = 90;
  static constexpr std::int64_t watchdog_ns =
      30'000'000;  // without a tick, after which motors are switched off
  /// Why: five times what the end of the loop takes, for a machine that others use as well; a driver that has not come back
  /// by then is not waited for.
  static constexpr std::chrono::milliseconds leave_behind_after{500};

  /// @param channels  outlive the loop; their sessions are the real-time thread's from start() to the end of finish()
  RealtimeLoop(std::vector<std::unique_ptr<ToolChannel>>& channels, double rate_Hz)
      : channels_(channels), rate_Hz_(rate_Hz) {}
  ~RealtimeLoop() { finish(); }

  void start();

  /// Forces ramp to zero, then the thread ends; returns when it has, within about 50 ms. Safe to repeat.
  /// @return false if the thread is in a driver that does not come back: it is left behind, and what it uses (channels, this)
  ///         must stay until the process has gone
  bool finish();

  /// Ticks done so far, up to date whatever the loop does. Any thread.
  std::uint64_t ticks_done() const noexcept { return heartbeat_.load(std::memory_order_relaxed); }
  std::uint64_t watchdog_stops() const noexcept { return watchdog_stops_.load(std::memory_order_relaxed); }
  /// The tool that is being ticked now; below 0: none. Any thread.
  int in_tool() const noexcept { return in_tool_.load(std::memory_order_relaxed); }

  /// Newest statistics; null before the first. One reading thread.
  const LoopStats* stats() noexcept { return published_.newest(); }

 private:
  void run() noexcept;
  void watch() noexcept;
  void tick_tools(std::int64_t woke_ns) noexcept;
  void tick_tool(ToolChannel& channel, HapticSession& session, std::int64_t woke_ns) noexcept;
  void measure(const Ticker::Wake& wake, std::int64_t cpu_ns) noexcept;
  bool all_stopped() const noexcept;

  std::vector<std::unique_ptr<ToolChannel>>& channels_;
  double rate_Hz_;
  std::thread thread_;
  std::thread watchdog_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> done_{false};
  std::atomic<bool> leave_{false};  // the watchdog's
  std::atomic<int> in_tool_{-1};
  bool left_behind_ = false;
  std::atomic<std::uint64_t> heartbeat_{0};
  std::atomic<std::uint64_t> watchdog_stops_{0};
  bool stopping_ = false;  // the real-time thread's own, as what follows
  LoopStats stats_;
  std::int64_t published_ns_ = 0;
  ThreadUsage warm_;  // what the thread had used up after its first second
  TripleBuffer<LoopStats> published_;
};

}  // namespace palpate::haptic
