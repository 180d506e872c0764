#pragma once
// What the eye is told of a world that runs in this process, when a picture is due.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/message/messages.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/appearance/appearance.h"
#include "physics_node/world.h"

namespace palpate::deploy {

/// Frames of the world from picture to picture.
inline std::int64_t frames_a_picture(const Scene& scene, const physics::World& world) {
  const double frames = 1 / (scene.render->rate_Hz * world.frame_seconds());
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(frames + 0.5));
}

class EyeMessages {
 public:
  EyeMessages(const Scene& scene, const physics::World& world)
      : appearance_(world, scene.render->threshold), traces_(scene.tools.size()) {
    for (std::uint32_t n = 0; n < traces_.size(); ++n) traces_[n].tool = n;
  }

  /// What a hand did in one of its ticks.
  template <class Eye>
  void take(std::uint32_t tool, const TraceSample& sample, Eye& eye) {
    HapticTrace& trace = traces_[tool];
    trace.samples[trace.n_samples++] = sample;
    if (trace.n_samples == max_trace_samples) pass(trace, eye);
  }

  /// Everything new since the last call.
  /// @param eye  has take() for each kind of message, as render::Picture has
  template <class Eye>
  void write(physics::World& world, std::int64_t now_ns, Eye& eye) {
    const bool anew = appearance_.poll();
    appearance_.write_blocks([&eye](const VertexBlock& block) { eye.take(block); });
    if (anew)
      appearance_.write_surfaces({[&eye](const BodySurface& chunk) { eye.take(chunk); },
                                  [&eye](const SurfaceChange& page) { eye.take(page); }});
    for (std::size_t n = 0; n < traces_.size(); ++n) {
      pass(traces_[n], eye);
      ToolWrench wrench;
      world.tool(n).write_wrench(wrench, static_cast<std::uint64_t>(world.report().frames), now_ns,
                                 world.t());
      eye.take(wrench);
    }
  }

 private:
  template <class Eye>
  void pass(HapticTrace& trace, Eye& eye) {
    if (trace.n_samples > 0) eye.take(trace);
    ++trace.batch;
    trace.n_samples = 0;
  }

  physics::Appearance appearance_;
  std::vector<HapticTrace> traces_;
};

}  // namespace palpate::deploy
