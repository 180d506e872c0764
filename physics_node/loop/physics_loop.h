#pragma once
// palpate-physics as it runs: one thread, one frame per 1 / frame_Hz of wall time, everything in order.

#include <memory>

#include "common/process/node_main.h"
#include "common/scene/scene.h"
#include "physics_node/appearance/appearance.h"
#include "physics_node/loop/hands.h"
#include "physics_node/loop/wire.h"
#include "physics_node/record/recorder.h"
#include "physics_node/report/run_warnings.h"
#include "physics_node/world.h"

namespace palpate::physics {

class PhysicsLoop {
 public:
  PhysicsLoop(const NodeOptions& options, const Scene& scene);

  /// Until a signal, a stop command or options.seconds. @return exit code
  int run();

 private:
  void go_on_from_record();
  bool take_tools();
  void take_commands();
  void publish_hand();
  void publish_eye();
  void publish_blocks();
  void publish_status(NodePhase phase);
  void tell_warnings();
  void note(std::string_view text);  // for the window
  bool leave();

  NodeOptions options_;
  Scene scene_;
  Wire wire_;
  Newcomer newcomer_{wire_.participant};
  std::unique_ptr<World> world_;
  std::unique_ptr<Appearance> appearance_;
  std::unique_ptr<Recorder> recorder_;

  Hands hands_;
  std::uint64_t hand_changes_ = 0;  // how often another hand had taken over, at the last look
  ContactPatch patch_{};
  ToolWrench wrench_{};
  bool paused_ = false;
  int frames_to_go_ = 0;   // before it stands still, while paused
  bool unheeded_ = false;  // a command that cannot be carried out has been named
  bool stop_ = false;
  bool unwelcome_ = false;           // in a session of another scene or version
  bool record_failed_ = false;       // said so
  std::uint64_t watchers_ever_ = 0;  // of vertex blocks, at the last look
  std::int64_t start_ns_ = 0;
  double began_t_ = 0;  // what a record was run again to [s]

  // status
  NodeStatus status_{};
  WarningKinds known_warnings_;  // logged
  std::int64_t last_status_ns_ = 0;
  double last_status_t_ = 0;
  std::int64_t last_status_frames_ = 0;
};

}  // namespace palpate::physics
