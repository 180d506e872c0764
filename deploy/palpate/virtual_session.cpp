#include "deploy/palpate/virtual_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "common/process/stop_flag.h"
#include "physics_node/report/physics_summary.h"

namespace palpate::deploy {

VirtualSession::VirtualSession(const Scene& scene, const VirtualOptions& options)
    : scene_(scene),
      options_(options),
      world_(scene_),
      patches_(scene.tools.size()),
      wrenches_(scene.tools.size()),
      states_(scene.tools.size()),
      traces_(scene.tools.size()) {
  for (std::uint32_t n = 0; n < scene_.tools.size(); ++n) {
    hands_.push_back(
        std::make_unique<haptic::HapticSession>(scene_, n, options.device, &VirtualSession::clock, this));
    next_tick_ns_.push_back(now_ns_);
    traces_[n].tool = n;
  }
  if (!options_.pictures) return;
  appearance_ = std::make_unique<physics::Appearance>(world_, scene_.render.threshold);
  picture_ = std::make_unique<render::Picture>(scene_);
}

void VirtualSession::leave_in(const std::filesystem::path& out) {
  out_ = out;
  recorder_ = std::make_unique<physics::Recorder>(world_, out.string(), physics::Recorder::WhenBehind::wait);
  if (picture_) std::filesystem::create_directories(out / "frames");
}

void VirtualSession::tick_hands(std::int64_t until_ns) {
  for (std::size_t n = 0; n < hands_.size(); ++n) {
    const auto period = static_cast<std::int64_t>(1e9 / hands_[n]->rate_Hz() + 0.5);
    while (next_tick_ns_[n] < until_ns) {
      now_ns_ = next_tick_ns_[n];
      next_tick_ns_[n] += period;
      hands_[n]->tick(patches_[n].tick > 0 ? &patches_[n] : nullptr, wrenches_[n].tick > 0 ? &wrenches_[n] : nullptr);
      states_[n] = hands_[n]->tool_state();
      HapticTrace& trace = traces_[n];
      trace.samples[trace.n_samples++] = hands_[n]->trace();
      if (trace.n_samples < max_trace_samples) continue;
      if (picture_) picture_->take(trace);
      ++trace.batch;
      trace.n_samples = 0;
    }
  }
  now_ns_ = until_ns;
}

void VirtualSession::tell_hands() {
  const auto frame = static_cast<std::uint64_t>(world_.report().frames);
  for (std::size_t n = 0; n < patches_.size(); ++n) {
    world_.tool(n).write_patch(patches_[n], frame, now_ns_);
    world_.tool(n).write_wrench(wrenches_[n], frame, now_ns_, world_.t());
  }
}

void VirtualSession::show() {
  if (appearance_->poll())
    appearance_->write_surfaces([this](const BodySurface& chunk) { picture_->take(chunk); });
  appearance_->write_blocks([this](const VertexBlock& block) { picture_->take(block); });
  for (std::size_t n = 0; n < traces_.size(); ++n) {
    if (traces_[n].n_samples > 0) picture_->take(traces_[n]);
    ++traces_[n].batch;
    traces_[n].n_samples = 0;
    ToolWrench wrench;
    world_.tool(n).write_wrench(wrench, static_cast<std::uint64_t>(world_.report().frames), now_ns_,
                                   world_.t());
    picture_->take(wrench);
  }
  picture_->draw(world_.t());
  if (!out_.empty()) picture_->save_png((out_ / "frames" / fmt::format("frame_{:05}.png", ++frames_)).string());
}

void VirtualSession::run(double seconds, const std::function<void(double)>& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const auto n_frames = static_cast<std::int64_t>(seconds / world_.frame_seconds() + 0.5);
  const auto frame_ns = static_cast<std::int64_t>(1e9 * world_.frame_seconds() + 0.5);
  const auto picture_every = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(1 / (scene_.render.rate_Hz * world_.frame_seconds()) + 0.5));
  tell_hands();
  for (std::int64_t f = 0; f < n_frames && !stop_requested() && !world_.has_stopped(); ++f) {
    tick_hands(now_ns_ + frame_ns);
    world_.frame(states_);
    tell_hands();
    if (recorder_) recorder_->frame(world_);
    if (picture_ && f % picture_every == 0) show();
    if (f % 50 == 0) progress(world_.t());
  }
  progress(world_.t());
  for (auto& hand : hands_) hand->close();
  wall_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

nlohmann::json VirtualSession::finish() {
  if (recorder_) recorder_->finish();
  nlohmann::json summary = physics::physics_summary(world_, recorder_.get(), wall_s_);
  if (!hands_.empty()) {
    const haptic::SessionCounts& counts = hands_.front()->counts();
    summary["haptic"] = {{"rate_Hz", hands_.front()->rate_Hz()},
                         {"energy_max_J", counts.energy_max},
                         {"stale_events", counts.stale_events},
                         {"faults", counts.faults}};
  }
  if (picture_) {
    summary["render"] = {{"frames", frames_},
                         {"fps", wall_s_ > 0 ? frames_ / wall_s_ : 0.0},
                         {"facets_visible", picture_->facets_visible()},
                         {"facets_total", picture_->facets_total()}};
  }
  return summary;
}

}  // namespace palpate::deploy
