#include "haptic_node/loop/wire.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/time/ticker.h"

namespace palpate::haptic {
namespace {

using namespace std::chrono_literals;
constexpr double publisher_Hz = 2000;  // looks for new states twice as often as they come
// The state is written this long after its stamp at most: looking then finds it at once.
constexpr std::int64_t look_after_ns = 60'000;
constexpr std::uint32_t batch_samples = 20;  // of a trace: 50 batches a second at 1 kHz
constexpr int most_refusals = 50;            // of one batch, a few seconds, before it is given up and counted

}  // namespace

Wire::Wire(const Membership& membership, std::vector<std::unique_ptr<ToolChannel>>& channels)
    : channels_(channels),
      participant_(membership),
      physics_(participant_, "physics", physics_silence),
      people_(participant_, {"render", "supervisor"}),
      patches_(participant_, &physics_),
      commands_(participant_, &people_),
      states_(participant_),
      traces_(participant_),
      status_(participant_),
      batches_(channels.size()),
      last_patch_(channels.size(), 0) {
  for (const auto& channel : channels_)
    if (channel->session.get()->controller().needs_wrench() && !wrenches_)
      wrenches_ = std::make_unique<Reader<ToolWrench>>(participant_, &physics_);
}

void Wire::start() {
  threads_.emplace_back([this] { receive(); });
  threads_.emplace_back([this] { publish(); });
  threads_.emplace_back([this] { trace_and_listen(); });
}

void Wire::finish() {
  end_.store(true);
  for (auto& thread : threads_) thread.join();
  threads_.clear();
}

/// By the ticks of physics: DDS does not tell a best-effort reader what it has missed, but gives nothing out of order. A
/// smaller tick is a physics that has begun again.
void Wire::count_gap(const ContactPatch& patch) noexcept {
  std::uint64_t& last = last_patch_[patch.tool];
  const bool gap = last > 0 && patch.tick > last + 1 && patch.tick - last <= PatchWatch::most_ahead;
  if (gap) patches_lost_ += patch.tick - last - 1;
  last = patch.tick;
}

/// Before what the new one says is passed on: the real-time thread then knows that its ticks are others.
void Wire::follow_physics() noexcept {
  const std::uint64_t changes = physics_.changes();
  if (channels_.empty() || channels_.front()->physics.load(std::memory_order_relaxed) == changes) return;
  for (const auto& channel : channels_) channel->physics.store(changes, std::memory_order_release);
  std::fill(last_patch_.begin(), last_patch_.end(), 0);
}

void Wire::receive() noexcept {
  ContactPatch patch;
  ToolWrench wrench;
  while (!end_.load()) {
    patches_.wait(20ms);
    // A wrench is sent just before the patch of the same frame.
    while (wrenches_ && wrenches_->take(wrench)) {
      follow_physics();
      if (wrench.tool < channels_.size()) channels_[wrench.tool]->wrenches.write(wrench);
    }
    while (patches_.take(patch)) {
      follow_physics();
      if (patch.tool >= channels_.size()) continue;
      count_gap(patch);
      channels_[patch.tool]->patches.write(patch);
    }
    HeardCounts counts;
    counts.patches = patches_.counts();
    counts.patches.lost = patches_lost_;
    if (wrenches_) counts.wrenches = wrenches_->counts();
    counts_.write(counts);
  }
}

void Wire::publish() noexcept {
  Ticker ticker(publisher_Hz);
  while (!end_.load()) {
    ticker.wait();
    for (const auto& channel : channels_) {
      bool is_new = false;
      const ToolState* state = channel->states.newest(&is_new);
      if (!is_new) continue;
      states_.write(*state);
      ticker.align(state->stamp_ns + look_after_ns);
    }
  }
}

/// Full batches, or all that is left; none is lost unless the wire refuses it again and again.
void Wire::drain(std::uint32_t tool, bool all) noexcept {
  ToolChannel& channel = *channels_[tool];
  Batch& batch = batches_[tool];
  batch.trace.tool = tool;
  for (;;) {
    while (batch.trace.n_samples < batch_samples &&
           channel.trace.pop(batch.trace.samples[batch.trace.n_samples]))
      ++batch.trace.n_samples;
    const bool due = batch.trace.n_samples == batch_samples || (all && batch.trace.n_samples > 0);
    if (!due) return;
    if (!traces_.write(batch.trace)) {
      if (++batch.refusals < most_refusals && !all) return;
      trace_refused_.fetch_add(batch.trace.n_samples);
    }
    batch.refusals = 0;
    batch.trace.batch += 1;
    batch.trace.n_samples = 0;
  }
}

void Wire::listen() noexcept {
  Command command;
  while (commands_.take(command)) {
    if (command.kind == CommandKind::stop) stop_commanded_.store(true);
    if (command.kind != CommandKind::device || command.value != 1.0) continue;
    for (const auto& channel : channels_)
      if (channel->name == command.name.data()) channel->reset_asked.store(true);
  }
  command_counts_.write(commands_.counts());
}

void Wire::trace_and_listen() noexcept {
  while (!end_.load()) {
    std::this_thread::sleep_for(5ms);
    listen();
    for (std::uint32_t tool = 0; tool < channels_.size(); ++tool) drain(tool, false);
  }
  for (std::uint32_t tool = 0; tool < channels_.size(); ++tool) drain(tool, true);
}

Wire::HeardCounts Wire::heard() const noexcept {
  const HeardCounts* counts = counts_.newest();
  return counts == nullptr ? HeardCounts{} : *counts;
}

ReaderCounts Wire::commands_heard() const noexcept {
  const ReaderCounts* counts = command_counts_.newest();
  return counts == nullptr ? ReaderCounts{} : *counts;
}

std::vector<std::string> Wire::remarks() {
  auto lines = physics_.remarks();
  for (auto& line : people_.remarks()) lines.push_back(std::move(line));
  return lines;
}

std::uint64_t Wire::trace_lost() const noexcept {
  std::uint64_t lost = trace_refused_.load();
  for (const auto& channel : channels_) lost += channel->trace_lost.load();
  return lost;
}

}  // namespace palpate::haptic
