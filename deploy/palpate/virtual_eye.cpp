#include "deploy/palpate/virtual_eye.h"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::deploy {

VirtualEye::VirtualEye(const Scene& scene, const physics::World& world)
    : appearance_(world, scene.render.threshold),
      picture_(scene),
      traces_(scene.tools.size()),
      every_(std::max<std::int64_t>(
          1, static_cast<std::int64_t>(1 / (scene.render.rate_Hz * world.frame_seconds()) + 0.5))) {
  for (std::uint32_t n = 0; n < traces_.size(); ++n) traces_[n].tool = n;
}

void VirtualEye::leave_in(const std::filesystem::path& folder) {
  folder_ = folder;
  std::filesystem::create_directories(folder);
}

void VirtualEye::take(std::uint32_t tool, const TraceSample& sample) {
  HapticTrace& trace = traces_[tool];
  trace.samples[trace.n_samples++] = sample;
  if (trace.n_samples == max_trace_samples) pass(trace);
}

void VirtualEye::pass(HapticTrace& trace) {
  if (trace.n_samples > 0) picture_.take(trace);
  ++trace.batch;
  trace.n_samples = 0;
}

void VirtualEye::frame(physics::World& world, std::int64_t now_ns) {
  if (seen_++ % every_ == 0) draw(world, now_ns);
}

void VirtualEye::draw(physics::World& world, std::int64_t now_ns) {
  if (appearance_.poll())
    appearance_.write_surfaces([this](const BodySurface& chunk) { picture_.take(chunk); });
  appearance_.write_blocks([this](const VertexBlock& block) { picture_.take(block); });
  for (std::size_t n = 0; n < traces_.size(); ++n) {
    pass(traces_[n]);
    ToolWrench wrench;
    world.tool(n).write_wrench(wrench, static_cast<std::uint64_t>(world.report().frames), now_ns, world.t());
    picture_.take(wrench);
  }
  picture_.draw(world.t());
  if (!folder_.empty()) picture_.save_png((folder_ / fmt::format("frame_{:05}.png", ++frames_)).string());
}

nlohmann::json VirtualEye::summary(double wall_s) const {
  return {{"frames", frames_},
          {"fps", wall_s > 0 ? frames_ / wall_s : 0.0},
          {"facets_visible", picture_.facets_visible()},
          {"facets_total", picture_.facets_total()}};
}

}  // namespace palpate::deploy
