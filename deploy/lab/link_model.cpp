#include "deploy/lab/link_model.h"

namespace palpate::lab {

void LinkModel::take(std::int64_t now_ns, int to, std::vector<std::uint8_t> bytes) {
  ++taken_;
  std::uniform_real_distribution<double> unit(0, 1);
  if (100 * unit(random_) < quality_.loss_percent) {
    ++lost_;
    return;
  }
  const double wait_ms = quality_.delay_ms + quality_.jitter_ms * unit(random_);
  waiting_.push({now_ns + static_cast<std::int64_t>(1e6 * wait_ms), taken_, to, std::move(bytes)});
}

std::optional<Frame> LinkModel::give(std::int64_t now_ns) {
  if (waiting_.empty() || waiting_.top().due_ns > now_ns) return {};
  Frame frame = waiting_.top();
  waiting_.pop();
  return frame;
}

std::optional<std::int64_t> LinkModel::next_due_ns() const {
  if (waiting_.empty()) return {};
  return waiting_.top().due_ns;
}

}  // namespace palpate::lab
