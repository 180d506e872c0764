#pragma once
// Tissue, hand and eye in one process, in simulated time: no threads of the nodes, no wire, no waiting. The objects
// are those that the three nodes run.

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/scene/scene.h"
#include "common/scene/scene_source.h"
#include "deploy/palpate/onlooker.h"
#include "deploy/palpate/virtual_eye.h"
#include "haptic_node/session.h"
#include "physics_node/loop/hands.h"
#include "physics_node/record/recorder.h"
#include "physics_node/world.h"

namespace palpate::deploy {

struct VirtualOptions {
  std::string device;  // driver instead of the scenes'; empty: the scene's
  bool pictures = true;
  Onlooker* onlooker = nullptr;  // besides; outlives the session
};

class VirtualSession {
 public:
  /// Everything that a person may have got wrong is found here; nothing is written.
  /// @throws InputError
  VirtualSession(const Scene& scene, const VirtualOptions& options);

  /// From now on the record and the pictures go to this folder. Before run().
  /// @param source  what the scene was read from
  void leave_in(const std::filesystem::path& out, const SceneSource& source);

  /// What a person should know about this scene: one line each.
  const std::vector<std::string>& remarks() const { return world_.remarks(); }

  /// Simulates until `seconds`, until a signal comes, or until the world has to give up. `progress` is called now and then with the time reached.
  void run(double seconds, const std::function<void(double t)>& progress);

  /// Closes the files. @return the summary of this run
  nlohmann::json finish();

 private:
  static std::int64_t clock(void* self) { return static_cast<VirtualSession*>(self)->now_ns_; }
  void tick_hands(std::int64_t until_ns);
  void tell_hands();
  std::string never_felt(std::size_t hand) const;

  Scene scene_;
  VirtualOptions options_;
  physics::World world_;
  std::int64_t now_ns_ = 1'000'000'000;  // not zero: zero means "never" in messages
  std::vector<std::unique_ptr<haptic::HapticSession>> hands_;
  std::vector<std::int64_t> next_tick_ns_;
  std::vector<haptic::ArmRefusal> refusals_;  // of each hand as long as its motors have never come on
  std::vector<ContactPatch> patches_;
  std::vector<ToolWrench> wrenches_;
  physics::Hands known_hands_;  // to the tissue
  std::unique_ptr<physics::Recorder> recorder_;
  std::unique_ptr<VirtualEye> eye_;
  std::vector<Onlooker*> onlookers_;
  double wall_s_ = 0;
};

}  // namespace palpate::deploy
