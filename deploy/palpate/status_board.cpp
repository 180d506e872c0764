#include "deploy/palpate/status_board.h"

namespace palpate::deploy {

void StatusBoard::expect(NodeKind node, int pid) {
  of(node) = Entry();
  of(node).pid = static_cast<std::uint32_t>(pid);
}

void StatusBoard::expect_elsewhere(NodeKind node) {
  of(node) = Entry();
  of(node).elsewhere = true;
}

void StatusBoard::note(const NodeStatus& status) {
  Entry& entry = of(status.node);
  if (!entry.elsewhere && (entry.pid == 0 || status.pid != entry.pid)) return;
  const bool was_running = entry.running();  // the first running status is about a period only partly run
  entry.newest = status;
  if (!was_running || !entry.running()) return;
  ++entry.n_running;
  entry.sum_rate_Hz += status.rate_Hz;
  entry.sum_real_time_factor += status.real_time_factor;
}

}  // namespace palpate::deploy
