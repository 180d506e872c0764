#pragma once
// What physics knows of the hands: the newest sample of each tool, in the order of their ticks, for as long as it
// counts. One schedule for palpate-physics, for a session in simulated time and for the bench.

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/message/messages.h"

namespace palpate::physics {

class Hands {
 public:
  /// So long a sample counts. After that the tool is without a hand, and any tick is a new start.
  /// Why: as long as a hand's force counts; another hand may then take over, on this PC or another.
  static constexpr std::chrono::milliseconds silence{50};

  explicit Hands(std::size_t n_tools) : hands_(n_tools), newest_(n_tools) {}

  /// A sample that came at `now_ns`, by the clock that every call here uses [ns]. Ordered by tick alone, since the
  /// clock of a hand may be another one.
  /// @return true if it is the newest of its tool; older ones, copies, and tools that are not there are left out
  bool take(const ToolState& state, std::int64_t now_ns) noexcept;

  /// Another hand has taken over: whatever it sends is a new start. The samples of the one before count no more.
  void begin_anew() noexcept;

  /// What a frame at `now_ns` gets, by tool: its newest sample, none where it is silent. Valid until the next call.
  std::span<const std::optional<ToolState>> at(std::int64_t now_ns) noexcept;

  /// Whether at() last had a sample of any tool.
  bool any() const noexcept;

  std::uint64_t samples_lost() const noexcept { return samples_lost_; }  // ticks that never came
  std::uint64_t ticks_rejected() const noexcept {
    return ticks_rejected_;
  }  // samples too far ahead to be true

 private:
  struct Hand {
    std::optional<ToolState> newest;
    std::int64_t came_ns = 0;
  };
  static bool is_silent(const Hand& hand, std::int64_t now_ns) noexcept;

  std::vector<Hand> hands_;
  std::vector<std::optional<ToolState>> newest_;
  std::uint64_t samples_lost_ = 0;
  std::uint64_t ticks_rejected_ = 0;
};

}  // namespace palpate::physics
