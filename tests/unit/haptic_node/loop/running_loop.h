#pragma once
// The real-time loop with one tool in wall time, and a test in the place of physics and of the slow threads.

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "haptic_node/loop/realtime_loop.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {

using namespace std::chrono_literals;

struct RunningLoop {
  explicit RunningLoop(const Scene& scene) {
    channels.push_back(std::make_unique<ToolChannel>(scene, 0, ""));
    loop = std::make_unique<RealtimeLoop>(channels, 1000);
    loop->start();
  }
  /// As the slow thread and physics would, for a while.
  void live(std::chrono::milliseconds span, bool with_patches) {
    live(span, with_patches, [] {});
  }
  template <class Each>
  void live(std::chrono::milliseconds span, bool with_patches, Each&& each) {
    const auto end = std::chrono::steady_clock::now() + span;
    while (std::chrono::steady_clock::now() < end) {
      if (with_patches) {
        if (const ToolState* state = channels[0]->states.newest()) {
          patch.answers = state->tick;
          patch.answers_ns = state->stamp_ns;
        }
        patch.tick += 1;
        channels[0]->patches.write(patch);
      }
      if (HapticSession* session = channels[0]->session.get()) session->service();
      if (const SessionReport* newest = channels[0]->reports.newest()) report = *newest;
      each();
      TraceSample sample;
      while (channels[0]->trace.pop(sample)) {
        in_order = in_order && sample.tick == last_tick + 1;
        last_tick = sample.tick;
      }
      std::this_thread::sleep_for(2ms);
    }
  }

  std::vector<std::unique_ptr<ToolChannel>> channels;
  std::unique_ptr<RealtimeLoop> loop;
  ContactPatch patch = flat_patch(1);
  SessionReport report;
  std::uint64_t last_tick = 0;
  bool in_order = true;
};

}  // namespace palpate::haptic::test
