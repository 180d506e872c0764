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

constexpr double passive_J = 0.1e-3;  // energy made out of nothing that measuring alone may show

/// What the note says of its tools, after what it says of rights: why forces are not on.
std::string reason_text(const NodeStatus& status) {
  const std::string note(status.note.data());
  const auto tools = note.find("; ");
  return tools == std::string::npos ? std::string() : fmt::format(" ({})", note.substr(tools + 2));
}

std::string node_text(NodeKind node, const StatusBoard::Entry& entry) {
  if (!entry.newest) return fmt::format(" | {} {}", name_of(node), entry.elsewhere ? "awaited" : "starting");
  const NodeStatus& status = *entry.newest;
  if (!entry.running()) {
    std::string text = fmt::format(" | {} {}", name_of(node), phase_text(status.phase));
    if (node == NodeKind::haptic) text += reason_text(status);
    return text;
  }
  std::string text = fmt::format(" | {} {:.0f} Hz", name_of(node), status.rate_Hz);
  if (node == NodeKind::physics) text += fmt::format(" x{:.2f}", status.real_time_factor);
  if (node == NodeKind::haptic) text += fmt::format(" loop {:.1f} ms", status.loop_age_ms_p50);
  if (status.surplus_J > passive_J) text += fmt::format(", NOT PASSIVE {:.2f} mJ", 1e3 * status.surplus_J);
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
