// palpate replay: runs a recorded session again and compares every state that the record has a hash of.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/file/scratch_folder.h"
#include "common/math/hash.h"
#include "common/process/checked_option.h"
#include "common/process/stop_flag.h"
#include "common/report/commit.h"
#include "common/report/json_file.h"
#include "common/report/warnings.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "deploy/palpate/out_folder.h"
#include "deploy/palpate/plotter.h"
#include "deploy/palpate/progress.h"
#include "deploy/palpate/subcommands.h"
#include "deploy/palpate/viewers.h"
#include "deploy/palpate/virtual_eye.h"
#include "physics_node/record/recorder.h"
#include "physics_node/record/replay.h"
#include "physics_node/report/physics_summary.h"

namespace palpate::deploy {
namespace {

namespace fs = std::filesystem;

struct ReplayOptions {
  std::string record;
  std::string out;  // empty: nothing is left behind
  double until = std::numeric_limits<double>::infinity();
  int threads = -1;
  bool pictures = false;
};

/// What the eye draws of a hand, from what physics heard of it.
TraceSample seen(const ToolState& state, double t) {
  TraceSample sample;
  sample.tick = state.tick;
  sample.t = t;
  sample.p = state.p_WT;
  sample.proxy = state.proxy;
  sample.force = state.force_now;
  sample.torque = state.torque_now;
  return sample;
}

/// The run, and what it leaves behind.
class Rerun {
 public:
  explicit Rerun(const ReplayOptions& options) : options_(options), record_(options.record) {
    auto [scene, source] = record_.lay_out(files_.path().string());
    if (options.threads >= 0) scene.physics->threads = options.threads;
    world_ = std::make_unique<physics::World>(scene);
    replay_ = std::make_unique<physics::Replay>(record_, *world_);
    if (options.pictures) eye_ = std::make_unique<VirtualEye>(scene, *world_);
    if (options.out.empty()) return;
    held_.emplace(prepare_out(options.out));
    recorder_ = std::make_unique<physics::Recorder>(*world_, source, options.out,
                                                    physics::Recorder::WhenBehind::wait);
    if (eye_) eye_->leave_in(options.out);
  }

  /// @return exit code
  int run() {
    const double whole =
        std::min(options_.until, static_cast<double>(record_.frames()) * world_->frame_seconds());
    Progress progress(whole);
    const auto begin = std::chrono::steady_clock::now();
    while (!stop_requested() && world_->t() < whole - 1e-9 && replay_->frame()) note(progress);
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    progress.show(whole);
    if (recorder_) leave(wall_s);
    return tell(wall_s);
  }

 private:
  void note(Progress& progress) {
    const auto& hands = replay_->hands();
    if (recorder_) recorder_->frame(*world_, hands);
    if (world_->report().frames % 50 == 0) progress.show(world_->t());
    if (!eye_) return;
    for (std::uint32_t n = 0; n < hands.size(); ++n)
      if (hands[n]) eye_->take(n, seen(*hands[n], world_->t()));
    eye_->frame(*world_, static_cast<std::int64_t>(1e9 * world_->t()));
  }

  void leave(double wall_s) {
    recorder_->finish(*world_);
    nlohmann::json summary = physics::physics_summary(*world_, recorder_.get(), wall_s);
    if (eye_) summary["render"] = eye_->summary(*world_, wall_s);
    const fs::path out = options_.out;
    write_json((out / "summary.json").string(), summary);
    fs::remove(out / "parts");  // the nodes' folder, empty here
    draw_plots(out);
    export_for_viewers(out, world_->scene());
    fmt::print("summary  {}\n", (out / "summary.json").string());
    for (const std::string& text : warnings_of(summary)) fmt::print(stderr, "palpate: {}\n", text);
  }

  int tell(double wall_s) const {
    if (const auto& difference = replay_->difference()) {
      const std::string own = commit();
      fmt::print(stderr,
                 "palpate: {}: the state differs after {:.3f} s (frame {}): recorded {}, now {}; {}\n",
                 record_.path(), difference->t, difference->frame, hex_of(difference->recorded),
                 hex_of(difference->found),
                 own == record_.commit()
                     ? "both were computed by commit " + own
                     : fmt::format("the record is of commit {}, this palpate of {}", record_.commit(), own));
      return exit_failed;
    }
    fmt::print("{:.3f} s run again in {:.2f} s, {} states compared: all as recorded\n", world_->t(), wall_s,
               replay_->compared());
    if (record_.cut_short())
      fmt::print("the record was cut short: it holds {:.3f} s\n",
                 static_cast<double>(record_.frames()) * world_->frame_seconds());
    return exit_ok;
  }

  const ReplayOptions& options_;
  ScratchFolder files_;  // of the record, which the export reads again at the end
  std::optional<HeldFolder> held_;
  physics::SessionRecord record_;
  std::unique_ptr<physics::World> world_;
  std::unique_ptr<physics::Replay> replay_;
  std::unique_ptr<VirtualEye> eye_;
  std::unique_ptr<physics::Recorder> recorder_;
};

int replay(ReplayOptions options) {
  if (options.pictures && options.out.empty()) options.out = (fs::path("out") / "replay").string();
  std::error_code ignored;
  if (!options.out.empty() && fs::equivalent(fs::path(options.out) / "record.h5", options.record, ignored))
    throw InputError(options.out +
                     ": holds the record that is to be run again; give another folder with --out");
  keep_as_private_as({options.record});
  install_stop_handlers();
  return Rerun(options).run();
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand("replay", "run a recorded session again and compare its states");
  command->add_option("record", options->record, "record.h5 of a run")->required();
  command->add_option("--until", options->until, "simulated time [s]")->check(number_in(run_seconds));
  command->add_option("--threads", options->threads, "threads of physics, 0: as many as pay")
      ->check(CLI::Range(0, 256));
  command->add_option("--out", options->out, "folder for record, traces and plots of this run");
  command->add_flag("--frames", options->pictures, "draw pictures (into out/replay, if no folder is given)");
  command->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace palpate::deploy
