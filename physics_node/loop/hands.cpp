#include "physics_node/loop/hands.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr std::int64_t silence_ns = std::chrono::nanoseconds(Hands::silence).count();
// Why: no hand makes so many ticks within that silence (20 kHz makes 1,000). A tick farther ahead is not one, and
// would shut out those that follow.
constexpr std::uint64_t most_ahead = 10'000;

}  // namespace

bool Hands::is_silent(const Hand& hand, std::int64_t now_ns) noexcept {
  return !hand.newest || now_ns - hand.came_ns > silence_ns;
}

bool Hands::take(const ToolState& state, std::int64_t now_ns) noexcept {
  if (state.tool >= hands_.size()) return false;
  Hand& hand = hands_[state.tool];
  if (!is_silent(hand, now_ns)) {
    if (state.tick <= hand.newest->tick) return false;
    const std::uint64_t ahead = state.tick - hand.newest->tick;
    if (ahead > most_ahead) {
      ++ticks_rejected_;
      return false;
    }
    samples_lost_ += ahead - 1;
  }
  hand.newest = state;
  hand.came_ns = now_ns;
  return true;
}

void Hands::begin_anew() noexcept {
  for (Hand& hand : hands_) hand.newest.reset();
}

std::span<const std::optional<ToolState>> Hands::at(std::int64_t now_ns) noexcept {
  for (std::size_t n = 0; n < hands_.size(); ++n)
    newest_[n] = is_silent(hands_[n], now_ns) ? std::nullopt : hands_[n].newest;
  return newest_;
}

bool Hands::any() const noexcept {
  return std::any_of(newest_.begin(), newest_.end(), [](const auto& hand) { return hand.has_value(); });
}

}  // namespace palpate::physics
