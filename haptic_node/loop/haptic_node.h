#pragma once
// palpate-haptic from start to end: devices opened, rights asked for, loop and wire running, summary written.

#include <memory>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "common/process/node_main.h"
#include "common/scene/scene.h"
#include "haptic_node/guardian/guardian.h"
#include "haptic_node/loop/call_watch.h"
#include "haptic_node/loop/crash_stop.h"
#include "haptic_node/loop/device_reset.h"
#include "haptic_node/loop/loop_watch.h"
#include "haptic_node/loop/realtime.h"
#include "haptic_node/loop/realtime_loop.h"
#include "haptic_node/loop/tool_channel.h"
#include "haptic_node/loop/tool_watch.h"
#include "haptic_node/loop/wire.h"

namespace palpate::haptic {

class HapticNode {
 public:
  /// @throws InputError: no tool, several rates, no such driver, no real-time rights with --require-rt
  HapticNode(const NodeOptions& options, const Scene& scene);

  /// Until a signal, a stop command, or options.seconds after forces were first on. Forces are zero and motors off
  /// before it returns. @return exit code; does not return where a driver hangs: the process ends then, all the same
  int run();

 private:
  void ask_for_rights();
  void set_guard();
  void serve();
  void look_at_tools();
  void keep_flights();
  std::string note() const;
  void take_counts(std::int64_t now);
  bool is_over() const;
  void publish_status(NodePhase phase);
  double seconds_so_far() const;
  bool close_devices();
  int leave();
  [[noreturn]] void leave_behind(int code);

  NodeOptions options_;
  Scene scene_;  // to open devices anew
  std::unique_ptr<Participant>
      first_;  // joins before any driver that speaks DDS does, so that the session's reach counts
  double rate_Hz_;
  RealtimeRights rights_;
  std::unique_ptr<Guardian> guardian_;  // goes after the devices
  std::vector<std::unique_ptr<ToolChannel>> channels_;
  Said said_;
  std::vector<ToolWatch> tools_;
  std::vector<DeviceReset> resets_;
  std::vector<int> flights_;  // written so far, by tool
  std::unique_ptr<Wire> wire_;
  std::unique_ptr<Newcomer> newcomer_;
  bool unwelcome_ = false;  // in a session of another scene or version
  std::unique_ptr<RealtimeLoop> loop_;
  std::unique_ptr<LoopWatch> loop_watch_;
  std::unique_ptr<CrashStop> crash_stop_;
  std::unique_ptr<CallWatch> calls_;
  NodeStatus status_;
};

}  // namespace palpate::haptic
