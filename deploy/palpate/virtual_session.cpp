#include "deploy/palpate/virtual_session.h"

#include <fmt/format.h>

#include <chrono>

#include "common/process/stop_flag.h"
#include "common/report/warnings.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "deploy/palpate/hand_warnings.h"
#include "physics_node/remarks/remarks.h"
#include "physics_node/report/physics_summary.h"

namespace palpate::deploy {

VirtualSession::VirtualSession(const Scene& scene, const VirtualOptions& options)
    : scene_(scene),
      options_(options),
      world_(scene_),
      patches_(scene.tools.size()),
      wrenches_(scene.tools.size()),
      known_hands_(scene.tools.size()) {
  world_.add_remarks(physics::remarks_about(world_));
  for (std::uint32_t n = 0; n < scene_.tools.size(); ++n) {
    hands_.push_back(
        std::make_unique<haptic::HapticSession>(scene_, n, options.device, &VirtualSession::clock, this));
    next_tick_ns_.push_back(now_ns_);
    refusals_.push_back(haptic::ArmRefusal::no_sample);
  }
  if (options_.pictures) eye_ = std::make_unique<VirtualEye>(scene_, world_);
  if (eye_) onlookers_.push_back(eye_.get());
  if (options_.onlooker != nullptr) onlookers_.push_back(options_.onlooker);
}

void VirtualSession::leave_in(const std::filesystem::path& out, const SceneSource& source) {
  recorder_ =
      std::make_unique<physics::Recorder>(world_, source, out.string(), physics::Recorder::WhenBehind::wait);
  if (eye_) eye_->leave_in(out);
}

void VirtualSession::tick_hands(std::int64_t until_ns) {
  for (std::size_t n = 0; n < hands_.size(); ++n) {
    const auto period = static_cast<std::int64_t>(1e9 / hands_[n]->rate_Hz() + 0.5);
    while (next_tick_ns_[n] < until_ns) {
      now_ns_ = next_tick_ns_[n];
      next_tick_ns_[n] += period;
      hands_[n]->tick(patches_[n].tick > 0 ? &patches_[n] : nullptr,
                      wrenches_[n].tick > 0 ? &wrenches_[n] : nullptr);
      if (refusals_[n] != haptic::ArmRefusal::none) refusals_[n] = hands_[n]->controller().refusal();
      known_hands_.take(hands_[n]->tool_state(), now_ns_);
      for (Onlooker* one : onlookers_) one->take(static_cast<std::uint32_t>(n), hands_[n]->trace());
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

void VirtualSession::run(double seconds, const std::function<void(double)>& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const auto n_frames = static_cast<std::int64_t>(seconds / world_.frame_seconds() + 0.5);
  const auto frame_ns = static_cast<std::int64_t>(1e9 * world_.frame_seconds() + 0.5);
  tell_hands();
  for (std::int64_t f = 0; f < n_frames && !stop_requested() && !world_.has_stopped(); ++f) {
    tick_hands(now_ns_ + frame_ns);
    const auto fresh = known_hands_.at(now_ns_);
    world_.frame(fresh);
    tell_hands();
    if (recorder_) recorder_->frame(world_, fresh);
    for (Onlooker* one : onlookers_) one->frame(world_, now_ns_);
    if (f % 50 == 0) progress(world_.t());
  }
  progress(world_.t());
  for (auto& hand : hands_) hand->close();
  wall_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// A hand whose motors never came on, in a run that gave it time: why, and what would help; empty: all is well.
std::string VirtualSession::never_felt(std::size_t hand) const {
  constexpr double time_to_arm = 0.5;  // [s]
  if (refusals_[hand] == haptic::ArmRefusal::none || world_.t() < time_to_arm) return {};
  const char* advice = refusals_[hand] == haptic::ArmRefusal::inside
                           ? "; let its path begin clear of the tissue by more than the tool's own size"
                           : "";
  return fmt::format("{}: its motors never came on: {}{}", scene_.tools[hand].name,
                     haptic::text_of(refusals_[hand]), advice);
}

nlohmann::json VirtualSession::finish() {
  if (recorder_) recorder_->finish(world_);
  nlohmann::json summary = physics::physics_summary(world_, recorder_.get(), wall_s_);
  if (!hands_.empty()) {
    const haptic::SessionCounts& counts = hands_.front()->counts();
    summary["haptic"] = {{"rate_Hz", hands_.front()->rate_Hz()}, {"energy_max_J", counts.energy_max},
                         {"force_max_N", counts.force_max},      {"torque_max_N_m", counts.torque_max},
                         {"stale_events", counts.stale_events},  {"faults", counts.faults}};
    if (counts.model_error >= 0) summary["haptic"]["model_error"] = counts.model_error;
  }
  std::vector<std::string> hand;
  for (std::size_t n = 0; n < hands_.size(); ++n) {
    const ForceModelChoice& felt = hands_[n]->force_model();
    summary["haptic"]["force_models"][scene_.tools[n].name] = word_of(felt.model);
    if (const auto line = warning_of(felt); !line.empty())
      hand.push_back(fmt::format("{}: {}", scene_.tools[n].name, line));
    if (const std::string line = never_felt(n); !line.empty()) hand.push_back(line);
    const haptic::FaultCause cause = hands_[n]->fault_cause();
    if (cause == haptic::FaultCause::none) continue;
    hand.push_back(
        fmt::format("{}: fault: {}; no force since then", scene_.tools[n].name, haptic::text_of(cause)));
    summary["haptic"]["fault_causes"].push_back({{"tool", scene_.tools[n].name},
                                                 {"cause", haptic::name_of(cause)},
                                                 {"text", haptic::text_of(cause)}});
  }
  add_warnings(summary, hand);
  if (eye_) summary["render"] = eye_->summary(world_, wall_s_);
  add_warnings(summary, hand_warnings(summary, Faults::named));
  count_warnings(summary);
  return summary;
}

}  // namespace palpate::deploy
