#pragma once
// The end of a session: haptic, physics, render, each told when the one before has gone or has had its time.

#include <chrono>
#include <vector>

#include "deploy/palpate/child.h"
#include "deploy/palpate/nodes.h"

namespace palpate::deploy {

struct RunningNode {
  NodeKind node;
  Child child;
  bool told = false;    // got SIGTERM from us
  bool killed = false;  // got SIGKILL from us
};

/// How long the end of a session may take.
struct Patience {
  std::chrono::milliseconds turn;   // before the next node is stopped although this one still runs
  std::chrono::milliseconds whole;  // before what still runs is killed
};
inline constexpr Patience calm = {std::chrono::milliseconds(500), std::chrono::milliseconds(5000)};
inline constexpr Patience hurried = {std::chrono::milliseconds(120), std::chrono::milliseconds(700)};

/// Ends all nodes and returns when none is left. A person's stop that comes meanwhile makes calm hurried.
void stop_nodes(std::vector<RunningNode>& nodes, Patience patience);

}  // namespace palpate::deploy
