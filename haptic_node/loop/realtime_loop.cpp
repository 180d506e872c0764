#include "haptic_node/loop/realtime_loop.h"

#include <algorithm>
#include <chrono>

#include "common/time/clock.h"
#include "haptic_node/loop/realtime.h"

namespace palpate::haptic {
namespace {

constexpr std::int64_t publish_every_ns = 50'000'000;
constexpr std::int64_t finish_within_ns = 100'000'000;

}  // namespace

void RealtimeLoop::start() {
  thread_ = std::thread([this] { run(); });
  watchdog_ = std::thread([this] { watch(); });
}

bool RealtimeLoop::finish() {
  stop_.store(true);
  const auto end = std::chrono::steady_clock::now() + leave_behind_after;
  while (thread_.joinable() && !done_.load() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (thread_.joinable()) {
    left_behind_ = !done_.load();
    if (left_behind_)
      thread_.detach();
    else
      thread_.join();
  }
  leave_.store(true);
  if (watchdog_.joinable()) watchdog_.join();
  return !left_behind_;
}

/// A tool whose session is taken back has no motors on.
bool RealtimeLoop::all_stopped() const noexcept {
  return std::all_of(channels_.begin(), channels_.end(), [](const auto& channel) {
    const HapticSession* session = channel->session.hold(ToolChannel::loop);
    const bool stopped = session == nullptr || session->stopped();
    channel->session.let_go(ToolChannel::loop);
    return stopped;
  });
}

void RealtimeLoop::tick_tool(ToolChannel& channel, HapticSession& session, std::int64_t woke_ns) noexcept {
  if (const std::uint64_t generation = channel.session.generation(); channel.attached != generation) {
    channel.attached = generation;
    session.attach();
  }
  if (stopping_) session.begin_stop();
  bool is_new = false;
  const ContactPatch* patch = channel.patches.newest(&is_new);
  // Not what was said to a hand before this one: that may have been by another machine's clock.
  const bool to_us = is_new && patch->answers > 0 && patch->answers <= session.counts().ticks &&
                     patch->answers_ns >= stats_.start_ns && patch->answers_ns <= woke_ns;
  if (to_us) stats_.loop_age.add(1e3 * seconds_from_ns(woke_ns - patch->answers_ns));
  const ToolWrench* wrench = channel.wrenches.newest();
  // Looked at after the answers: who spoke them has been written down before.
  if (const auto physics = channel.physics.load(std::memory_order_acquire);
      physics != channel.physics_heard) {
    channel.physics_heard = physics;
    session.listen_anew();
  }
  const HapticState before = session.state();
  session.tick(patch, wrench);
  channel.states.write(session.tool_state());
  if (!channel.trace.push(session.trace())) channel.trace_lost.fetch_add(1);
  channel.flight.add({session.trace(), session.tool_state().q_WT, session.state(), session.counts().surplus,
                      session.patch_age()});
  const bool fault = session.state() == HapticState::fault && before != HapticState::fault;
  if (fault || watchdog_stops_.load(std::memory_order_relaxed) != stats_.watchdog_stops)
    channel.flight.trigger();
  channel.reports.write({session.state(), session.controller().refusal(), session.counts(),
                         session.first_run_ns(), session.fault_cause(), session.temperature(),
                         session.controller().thermal_gain(), session.sample_age(), session.force_model()});
}

void RealtimeLoop::tick_tools(std::int64_t woke_ns) noexcept {
  for (std::size_t tool = 0; tool < channels_.size(); ++tool) {
    ToolChannel& channel = *channels_[tool];
    in_tool_.store(static_cast<int>(tool), std::memory_order_relaxed);
    if (HapticSession* session = channel.session.hold(ToolChannel::loop))
      tick_tool(channel, *session, woke_ns);
    channel.session.let_go(ToolChannel::loop);
  }
  in_tool_.store(-1, std::memory_order_relaxed);
}

/// @param cpu_ns  of this thread when it woke
void RealtimeLoop::measure(const Ticker::Wake& wake, std::int64_t cpu_ns) noexcept {
  if (stats_.last_ns > 0) stats_.period.add(1e-3 * static_cast<double>(wake.woke_ns - stats_.last_ns));
  stats_.last_ns = wake.woke_ns;
  stats_.ticks += 1;
  stats_.skipped += wake.skipped;
  stats_.lateness[octave_bin((wake.woke_ns - wake.due_ns) / 1000, histogram_bins)] += 1;
  stats_.watchdog_stops = watchdog_stops_.load(std::memory_order_relaxed);
  stats_.compute.add(1e-3 * static_cast<double>(now_ns() - wake.woke_ns));
  stats_.compute_cpu.add(1e-3 * static_cast<double>(thread_cpu_ns() - cpu_ns));
  if (wake.woke_ns - published_ns_ < publish_every_ns) return;
  published_ns_ = wake.woke_ns;
  const ThreadUsage usage = usage_of_this_thread();
  if (stats_.ticks <= static_cast<std::uint64_t>(rate_Hz_)) warm_ = usage;
  stats_.page_faults = usage.page_faults - warm_.page_faults;
  stats_.preempted = usage.preempted - warm_.preempted;
  published_.write(stats_);
}

void RealtimeLoop::run() noexcept {
  enter_realtime(priority);
  Ticker ticker(rate_Hz_);
  stats_.start_ns = now_ns();
  std::int64_t stop_ns = 0;
  // 1. wait  2. tick every tool  3. measure
  for (;;) {
    const Ticker::Wake wake = ticker.wait();
    const std::int64_t cpu_ns = thread_cpu_ns();
    if (stop_.load(std::memory_order_relaxed) && stop_ns == 0) {
      stop_ns = wake.woke_ns;
      stopping_ = true;
    }
    tick_tools(wake.woke_ns);
    heartbeat_.fetch_add(1, std::memory_order_release);
    measure(wake, cpu_ns);
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
  while (!done_.load() && !leave_.load()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::uint64_t beat = heartbeat_.load(std::memory_order_acquire);
    if (beat == 0 || beat != seen) {
      seen = beat;
      seen_ns = now_ns();
      stopped = false;
    } else if (!stopped && now_ns() - seen_ns > watchdog_ns) {
      for (const auto& channel : channels_) {
        if (HapticSession* session = channel->session.hold(ToolChannel::watchdog)) session->stop_motors();
        channel->session.let_go(ToolChannel::watchdog);
      }
      watchdog_stops_.fetch_add(1);
      stopped = true;
    }
  }
}

}  // namespace palpate::haptic
