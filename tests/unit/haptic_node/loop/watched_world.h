#pragma once
// A virtual world on the watched driver, whose device can be unplugged and opened anew.

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "common/scene/scene.h"
#include "tests/support/devices/watched_device.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {

inline std::string watched_file() {
  // Why: pages of a file on a disk fault when they are written first, wherever they are mapped.
  return "/dev/shm/palpate_watched_" + std::to_string(getpid());
}

/// `scene`, with the watched driver in the place of the simulated one.
inline Scene watched(Scene scene) {
  setenv("PALPATE_DRIVERS", WATCHED_DRIVERS, 1);
  return scene;
}

struct WatchedWorld {
  explicit WatchedWorld(const Scene& the_scene)
      : file(watched_file(), palpate::test::WatchedFile::Role::test),
        scene(watched(the_scene)),
        session(std::make_unique<HapticSession>(scene, 0, "", &read_clock, &now)) {}

  /// As the node does when a person asks for it.
  void replug() {
    session->close();
    auto fresh = std::make_unique<HapticSession>(scene, 0, "", &read_clock, &now);
    fresh->go_on_from(*session);
    session = std::move(fresh);
  }
  void tick() {
    patch.tick += 1;
    session->tick(&patch);
    now += 1'000'000;
  }
  template <class Each>
  void run(int ticks, Each&& each) {
    for (int i = 0; i < ticks; ++i) {
      tick();
      each();
    }
  }
  void run(int ticks) {
    run(ticks, [] {});
  }
  double fz() const { return session->trace().force[2]; }
  double z() const { return session->tool_state().p_WT[2]; }

  palpate::test::WatchedFile file;
  Scene scene;
  std::int64_t now = 1'000'000'000;
  ContactPatch patch = flat_patch(1);
  std::unique_ptr<HapticSession> session;
};

}  // namespace palpate::haptic::test
