#include "deploy/palpate/stop_nodes.h"

#include <algorithm>
#include <csignal>
#include <thread>

#include "common/process/stop_flag.h"

namespace palpate::deploy {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto look_again = std::chrono::milliseconds(2);

class Stopper {
 public:
  Stopper(std::vector<RunningNode>& nodes, Patience patience)
      : nodes_(nodes), hasty_(stop_requested()), turn_(patience.turn), end_(Clock::now() + patience.whole) {}

  /// Tells one node and waits for its turn to be over.
  void take_turn(RunningNode& node) {
    if (node.child.ending()) return;
    node.told = true;
    node.child.signal(SIGTERM);
    const auto over = Clock::now() + turn_;
    while (!node.child.ending() && Clock::now() < std::min(over, end_)) rest();
  }

  void finish() {
    while (any_left() && Clock::now() < end_) rest();
    for (RunningNode& node : nodes_) {
      if (node.child.ending()) continue;
      node.killed = true;
      node.child.signal(SIGKILL);
      node.child.wait();
    }
  }

 private:
  bool any_left() {
    return std::any_of(nodes_.begin(), nodes_.end(), [](RunningNode& node) { return !node.child.ending(); });
  }

  void rest() {
    std::this_thread::sleep_for(look_again);
    if (hasty_ || !stop_requested()) return;
    hasty_ = true;
    turn_ = std::min(turn_, hurried.turn);
    end_ = std::min(end_, Clock::now() + hurried.whole);
  }

  std::vector<RunningNode>& nodes_;
  bool hasty_;
  std::chrono::milliseconds turn_;
  Clock::time_point end_;
};

}  // namespace

void stop_nodes(std::vector<RunningNode>& nodes, Patience patience) {
  Stopper stopper(nodes, patience);
  for (const NodeKind kind : stop_order) {
    for (RunningNode& node : nodes) {
      if (node.node == kind) stopper.take_turn(node);
    }
  }
  stopper.finish();
}

}  // namespace palpate::deploy
