#include "deploy/palpate/virtual_eye.h"

#include <algorithm>

#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::deploy {

VirtualEye::VirtualEye(const Scene& scene, const physics::World& world)
    : appearance_(world, scene.render->threshold),
      picture_(scene),
      traces_(scene.tools.size()),
      spec_(*scene.render),
      every_(std::max<std::int64_t>(
          1, static_cast<std::int64_t>(1 / (scene.render->rate_Hz * world.frame_seconds()) + 0.5))) {
  for (std::uint32_t n = 0; n < traces_.size(); ++n) traces_[n].tool = n;
}

void VirtualEye::leave_in(const std::filesystem::path& out) { folder_.emplace(out, spec_); }

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
  if (seen_++ % every_ == 0 && (!folder_ || folder_->wants_next())) draw(world, now_ns);
}

void VirtualEye::draw(physics::World& world, std::int64_t now_ns) {
  const bool anew = appearance_.poll();
  appearance_.write_blocks([this](const VertexBlock& block) { picture_.take(block); });
  if (anew)
    appearance_.write_surfaces({[this](const BodySurface& chunk) { picture_.take(chunk); },
                                [this](const SurfaceChange& page) { picture_.take(page); }});
  for (std::size_t n = 0; n < traces_.size(); ++n) {
    pass(traces_[n]);
    ToolWrench wrench;
    world.tool(n).write_wrench(wrench, static_cast<std::uint64_t>(world.report().frames), now_ns, world.t());
    picture_.take(wrench);
  }
  picture_.draw(world.t());
  ++drawn_;
  if (folder_) folder_->keep(picture_.image());
}

nlohmann::json VirtualEye::summary(double wall_s) {
  nlohmann::json summary = {{"frames", drawn_},
                            {"fps", wall_s > 0 ? drawn_ / wall_s : 0.0},
                            {"facets_visible", picture_.facets_visible()},
                            {"facets_total", picture_.facets_total()}};
  if (!folder_) return summary;
  folder_->settle();
  summary["frames"] = folder_->kept();
  if (folder_->lost() > 0) summary["frames_lost"] = folder_->lost();
  if (folder_->every() > 1)
    summary.update({{"frames_left_out", folder_->left_out()}, {"frames_every", folder_->every()}});
  return summary;
}

}  // namespace palpate::deploy
