#pragma once
// What the nodes of a session say of themselves: the newest status of each, and means over the time it ran.

#include <array>
#include <cstdint>
#include <optional>

#include "common/message/messages.h"

namespace palpate::deploy {

class StatusBoard {
 public:
  struct Entry {
    std::uint32_t pid = 0;             // of the process we started; 0: none
    bool elsewhere = false;            // another PC brings it
    std::optional<NodeStatus> newest;  // nothing: not seen yet
    std::uint64_t n_running = 0;       // statuses with phase running, but for the first
    double sum_rate_Hz = 0;
    double sum_real_time_factor = 0;

    bool running() const { return newest && newest->phase == NodePhase::running; }
    double mean_rate_Hz() const { return n_running == 0 ? 0 : sum_rate_Hz / static_cast<double>(n_running); }
    double mean_real_time_factor() const {
      return n_running == 0 ? 0 : sum_real_time_factor / static_cast<double>(n_running);
    }
  };

  /// From now on this process is the node.
  void expect(NodeKind node, int pid);

  /// Another PC brings this node; whichever speaks for it is believed.
  void expect_elsewhere(NodeKind node);

  /// Takes a status up; one from a process that we neither started nor expect changes nothing.
  void note(const NodeStatus& status);

  const Entry& at(NodeKind node) const { return entries_[static_cast<std::size_t>(node)]; }

 private:
  Entry& of(NodeKind node) { return entries_[static_cast<std::size_t>(node)]; }

  std::array<Entry, n_node_kinds> entries_;
};

}  // namespace palpate::deploy
