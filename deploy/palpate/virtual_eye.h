#pragma once
// Pictures of a world that runs in this process, in simulated time, into a folder.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/scene/render_spec.h"
#include "common/scene/scene_fwd.h"
#include "deploy/palpate/eye_messages.h"
#include "deploy/palpate/onlooker.h"
#include "physics_node/world.h"
#include "render_node/image/frame_folder.h"
#include "render_node/picture.h"

namespace palpate::deploy {

class VirtualEye final : public Onlooker {
 public:
  VirtualEye(const Scene& scene, const physics::World& world);

  /// From now on pictures go to OUT/frames. @throws InputError as FrameFolder does
  void leave_in(const std::filesystem::path& out);

  void take(std::uint32_t tool, const TraceSample& sample) override;
  /// Draws when a picture is due.
  void frame(physics::World& world, std::int64_t now_ns) override;

  /// The part `render` of summary.json. Facets are of the end, maybe later than the last picture.
  nlohmann::json summary(physics::World& world, double wall_s);

 private:
  void draw(physics::World& world, std::int64_t now_ns);

  EyeMessages messages_;
  render::Picture picture_;
  RenderSpec spec_;
  std::optional<render::FrameFolder> folder_;
  std::int64_t every_ = 1;  // frames of the world from picture to picture
  std::int64_t seen_ = 0;
  int drawn_ = 0;
};

}  // namespace palpate::deploy
