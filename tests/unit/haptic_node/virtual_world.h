#pragma once
// One-line worlds for the tests of the hand: a scene with one tool on a simulated device, a clock that stands still
// until told, and patches of a flat tissue.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "common/message/messages.h"
#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "haptic_node/session.h"

namespace palpate::haptic::test {

/// Drivers are found where this build has put them.
inline void use_built_drivers() { setenv("PALPATE_DRIVERS", PALPATE_TEST_DRIVERS, 1); }

inline Scene scene_with(HandModel hand, std::vector<Waypoint> waypoints, double stiffness = 400) {
  use_built_drivers();
  Scene scene;
  ToolSpec tool;
  tool.name = "tip";
  tool.device = "hand";
  tool.stiffness = stiffness;
  scene.tools.push_back(tool);
  DeviceSpec device;
  device.name = "hand";
  device.driver = "simulated";
  device.hand = hand;
  device.waypoints = std::move(waypoints);
  scene.devices.push_back(device);
  return scene;
}

/// 0.3 s down from 20 mm to `depth` below z = 0, then rest.
inline std::vector<Waypoint> press(double depth) { return {{0, {0, 0, 0.02}}, {0.3, {0, 0, -depth}}}; }

inline std::int64_t read_clock(void* clock) { return *static_cast<std::int64_t*>(clock); }

/// A square of 2 x 40 mm side, split into two triangles, that faces along +z at height `z`.
inline ContactPatch flat_patch(std::uint64_t tick, double z = 0, double stiffness = rigid_stiffness) {
  constexpr double a = 0.04;
  ContactPatch patch;
  patch.tick = tick;
  patch.contact_set = 1;
  patch.n_facets = 2;
  patch.facets[0].corners = {{{-a, -a, z}, {a, -a, z}, {a, a, z}}};
  patch.facets[1].corners = {{{-a, -a, z}, {a, a, z}, {-a, a, z}}};
  for (PatchFacet* facet : {&patch.facets[0], &patch.facets[1]}) {
    facet->point = {0, 0, z};
    facet->normal = {0, 0, 1};
    facet->stiffness = stiffness;
  }
  return patch;
}

/// A session in simulated time with patches of a fixed flat tissue.
struct VirtualWorld {
  explicit VirtualWorld(const Scene& scene) : session(scene, 0, "", &read_clock, &now) {
    patch = flat_patch(1);
    period_ns = static_cast<std::int64_t>(1e9 / session.rate_Hz());
  }

  /// Ticks for `seconds`; while `patches_Hz` > 0 the patch is renewed at that rate.
  template <class Each>
  void run(double seconds, double patches_Hz, Each&& each) {
    const std::int64_t end = now + static_cast<std::int64_t>(seconds * 1e9);
    const std::int64_t every = patches_Hz > 0 ? static_cast<std::int64_t>(1e9 / patches_Hz) : 0;
    while (now < end) {
      if (every > 0 && now >= next_patch) {
        patch.tick += 1;
        has_patch = true;
        next_patch = now + every;
      }
      session.tick(has_patch ? &patch : nullptr);
      each();
      now += period_ns;
    }
  }
  void run(double seconds, double patches_Hz) {
    run(seconds, patches_Hz, [] {});
  }

  double fz() const { return session.trace().force[2]; }
  double z() const { return session.tool_state().p_WT[2]; }
  double force() const {
    const Array3& f = session.trace().force;
    return std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  }

  std::int64_t now = 1'000'000'000;
  std::int64_t next_patch = 0;
  std::int64_t period_ns = 1'000'000;
  bool has_patch = false;
  ContactPatch patch;
  HapticSession session;
};

}  // namespace palpate::haptic::test
