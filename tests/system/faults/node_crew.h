#pragma once
// palpate-physics, -haptic and -render as processes of their own, for a test that kills, stops and starts them.

#include <sys/types.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/message/messages.h"

namespace palpate::test {

inline constexpr std::array crew_nodes = {NodeKind::physics, NodeKind::haptic, NodeKind::render};

class NodeCrew {
 public:
  /// @param programs  folder of the nodes' programs  @param folder  scene.toml lies there; log and out/ will
  NodeCrew(std::filesystem::path programs, std::filesystem::path folder, int domain);
  ~NodeCrew();  // kills who is left
  NodeCrew(const NodeCrew&) = delete;
  NodeCrew& operator=(const NodeCrew&) = delete;

  void start(NodeKind node);
  void signal(NodeKind node, int number) const;
  /// Whether a node that was told to end has ended. @param status  how, as waitpid tells
  bool has_ended(NodeKind node, int& status);
  /// Kills who is there, and waits.
  void kill_now(NodeKind node);

  pid_t pid(NodeKind node) const { return pids_[static_cast<std::size_t>(node)]; }  // below 0: is not there
  const std::vector<pid_t>& ever() const { return ever_; }                          // all that were started
  /// Nodes that ended though nobody told them to, one line each, since the last call.
  std::vector<std::string> crashed();
  std::string log() const;

 private:
  pid_t& slot(NodeKind node) { return pids_[static_cast<std::size_t>(node)]; }

  std::filesystem::path programs_, folder_;
  int domain_;
  std::array<pid_t, 3> pids_{-1, -1, -1};
  std::vector<pid_t> ever_;
};

const char* name_of(NodeKind node);

}  // namespace palpate::test
