#pragma once
// What the main() of every node shares: its command line, and what becomes of an InputError.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "common/wire/companions.h"

namespace palpate {

/// The command line of palpate-physics, palpate-haptic and palpate-render:
///   SCENE [--set table.key=value]... [--out DIR] [--domain N] [--seconds T] [--device DRIVER] [--headless] [--require-rt]
///         [--interface NAME|ADDRESS] [--peers HOST,HOST] [--from RECORD [--at T]]
struct NodeOptions {
  std::string scene_path;
  std::vector<std::string> settings;
  std::string out;     // folder for what this node leaves; empty: nothing is written
  int domain = 0;      // DDS domain
  Reach reach;         // which machines it talks to
  double seconds = 0;  // stop after this much simulated time; 0: until told
  std::string device;  // driver instead of the scene's; empty: the scene's
  std::string from;    // physics: a record to begin from; empty: the scene as it is loaded
  double at = std::numeric_limits<double>::infinity();  // where in it [s]; infinite: its end
  bool headless = false;                                // render: frames to files, no window
  bool require_rt = false;                              // haptic: no real-time rights is fatal
};

/// How a node joins its session.
Membership membership(const NodeOptions& options, const Scene& scene, const std::string& role);

/// A node that comes to a session of another scene or version, or to one that has a node of its role already,
/// ends and says why: it checks its companions for its first seconds. The process that was there first stays,
/// and names the newcomer.
class Newcomer {
 public:
  /// @param own  who asks; may look before it is seen itself, through a participant that is nobody
  Newcomer(Participant& participant, const Identity& own);
  explicit Newcomer(Participant& participant) : Newcomer(participant, participant.identity()) {}

  /// Before anything is said or opened: waits until discovery has had its time, some 30 ms in a session and 200 ms where
  /// nobody is. @throws InputError, a line for each who does not fit
  void settle();
  /// True if this node must go (exit_mistake); what there is to say has then been logged. Call it now and then, never
  /// from a real-time thread.
  bool must_go();

 private:
  std::vector<std::string> reasons_to_go();
  void name_doubles();

  Companions companions_;
  Identity own_;
  std::int64_t began_ns_;
  std::vector<Identity> named_;  // doubles that have been named
};

/// Reads the command line and the scene, calls `run`, and turns InputError into one line each on stderr and exit 2,
/// any other exception into one line and exit 1.
int node_main(int argc, char** argv, const char* name,
              const std::function<int(const NodeOptions&, const Scene&)>& run);

}  // namespace palpate
