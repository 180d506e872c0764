#include "deploy/palpate/status_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "deploy/palpate/nodes.h"

namespace palpate::deploy {
namespace {

constexpr auto between_lines = std::chrono::seconds(2);
constexpr auto between_updates = std::chrono::milliseconds(200);

std::string_view phase_text(NodePhase phase) {
  switch (phase) {
    case NodePhase::loading:
      return "loading";
    case NodePhase::ready:
      return "ready";
    case NodePhase::running:
      return "running";
    case NodePhase::stopping:
      return "stopping";
    case NodePhase::failed:
      return "failed";
  }
  return "unknown";
}

std::string node_text(NodeKind node, const StatusBoard::Entry& entry) {
  if (!entry.newest) return fmt::format(" | {} {}", name_of(node), entry.elsewhere ? "awaited" : "starting");
  const NodeStatus& status = *entry.newest;
  if (!entry.running()) return fmt::format(" | {} {}", name_of(node), phase_text(status.phase));
  std::string text = fmt::format(" | {} {:.0f} Hz", name_of(node), status.rate_Hz);
  if (node == NodeKind::physics) text += fmt::format(" x{:.2f}", status.real_time_factor);
  if (node == NodeKind::haptic) text += fmt::format(" loop {:.1f} ms", status.loop_age_ms_p50);
  return text;
}

}  // namespace

std::string status_text(const StatusBoard& board, const std::vector<NodeKind>& nodes, double seconds) {
  std::string text = fmt::format("{:6.1f} s", seconds);
  unsigned warnings = 0;
  for (const NodeKind node : nodes) {
    text += node_text(node, board.at(node));
    if (board.at(node).newest) warnings += board.at(node).newest->warnings;
  }
  if (warnings > 0) text += fmt::format(" | {} warning{}", warnings, warnings == 1 ? "" : "s");
  return text;
}

StatusLine::StatusLine() : terminal_(isatty(STDOUT_FILENO) != 0) {}

void StatusLine::show(const StatusBoard& board, const std::vector<NodeKind>& nodes, double seconds) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? Clock::duration(between_updates) : Clock::duration(between_lines));
  const std::string text = status_text(board, nodes, seconds);
  if (terminal_) {
    std::printf("\r%s\033[K", text.c_str());
    open_ = true;
  } else {
    std::printf("%s\n", text.c_str());
  }
  std::fflush(stdout);
}

void StatusLine::finish() {
  if (open_) std::printf("\n");
  std::fflush(stdout);
  open_ = false;
}

}  // namespace palpate::deploy
