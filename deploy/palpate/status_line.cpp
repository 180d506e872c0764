#include "deploy/palpate/status_line.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
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

std::string times(std::uint64_t n, std::string_view what) {
  return n == 0 ? std::string() : fmt::format("{}{}", what, n == 1 ? "" : fmt::format(" ({} times)", n));
}

/// What a node warns of, in words. The note of the hand says how its tools fare, so that its counts speak instead.
std::string warning_text(const NodeStatus& status) {
  if (status.warnings == 0) return {};
  std::string words;
  if (status.node == NodeKind::haptic) {
    for (const auto& part :
         {times(status.stale_events, "physics was silent for the hand"),
          times(status.safe_events, "no force was sent to the hand"),
          times(status.warnings - std::min(status.warnings, status.stale_events + status.safe_events),
                "the hand's loop stood still")})
      if (!part.empty()) words += (words.empty() ? "" : ", ") + part;
  } else {
    words = status.note.data();
  }
  if (words.empty()) words = fmt::format("{} warns, and does not say of what", name_of(status.node));
  return " | " + words;
}

}  // namespace

std::string cut_to(const std::string& line, std::size_t columns) {
  if (columns < 4 || line.size() <= columns) return line;
  std::size_t end = columns - 3;
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80) --end;  // not within a character
  return line.substr(0, end) + "...";
}

std::string status_text(const StatusBoard& board, const std::vector<NodeKind>& nodes, double seconds) {
  std::string text = fmt::format("{:6.1f} s", seconds);
  for (const NodeKind node : nodes) text += node_text(node, board.at(node));
  for (const NodeKind node : nodes)
    if (board.at(node).newest) text += warning_text(*board.at(node).newest);
  return text;
}

StatusLine::StatusLine() : terminal_(isatty(STDOUT_FILENO) != 0) {}

void StatusLine::show(const StatusBoard& board, const std::vector<NodeKind>& nodes, double seconds) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? Clock::duration(between_updates) : Clock::duration(between_lines));
  const std::string text = status_text(board, nodes, seconds);
  if (terminal_) {
    winsize size{};
    const std::size_t columns =
        ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1U : 0;
    std::printf("\r%s\033[K", cut_to(text, columns).c_str());  // a longer line would not be written over
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
