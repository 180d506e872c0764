#pragma once
// Starts the nodes of a session, watches over them and ends them in order: the haptic node first, so that the force on
// the hand is zero before anything else goes.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "common/wire/participant.h"
#include "deploy/palpate/child.h"

namespace palpate::deploy {

struct SessionPlan {
  std::vector<NodeKind> nodes;
  std::vector<NodeKind> elsewhere;     // nodes that another PC brings; waited for, not watched over
  std::filesystem::path bin;           // folder of the nodes' programs
  std::vector<std::string> arguments;  // of every node
  Membership membership;               // of the supervisor; its identity is what all others are compared with
  double seconds = 0;                  // from the moment all nodes run; only said where `until_closed`
  bool simulated_too = false;    // physics must have come so far, too: what happens slowly is seen to its end
  bool until_closed = false;     // a window is open: it lasts until a person closes that, or presses Ctrl-C
  std::function<void()> ending;  // called before nodes are stopped; empty: nothing
};

struct NodeOutcome {
  NodeKind node = NodeKind::physics;
  bool seen = false;             // it published its status
  std::optional<Ending> ending;  // nothing: it could not be started
  bool killed = false;           // by us, because it did not end in time
  double mean_rate_Hz = 0;       // over the statuses of its running phase
  double mean_real_time_factor = 0;
};

struct SessionResult {
  int exit_code = 0;         // 0 done or stopped by a person; 1 a node failed; 2 a node found a mistake
  bool interrupted = false;  // by Ctrl-C or SIGTERM
  double wall_s = 0;         // that all nodes ran
  std::vector<NodeOutcome> nodes;
};

/// Runs a session from start to end, with a status line on stdout and one line on stderr for each node that fails.
/// A person's stop (common/process/stop_flag.h) ends everything within a second; a node that hangs is then killed.
/// Across PCs a session first looks who is there: nodes of another scene or version, or a node that this PC brings as
/// well, are a mistake and nothing is started. What comes later and does not fit ends the session if it stays.
/// A node that ends by itself with exit code 0 once all run (its window was closed) ends the session as done.
/// @throws InputError as said above, std::runtime_error if DDS or a process cannot be had; nothing is then left running
SessionResult run_session(const SessionPlan& plan);

}  // namespace palpate::deploy
