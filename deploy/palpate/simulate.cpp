// palpate simulate: a scene in simulated time, as fast as it goes, the same bits every time.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/process/checked_option.h"
#include "common/process/stop_flag.h"
#include "common/report/json_file.h"
#include "common/report/warnings.h"
#include "common/scene/load_scene.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "deploy/palpate/film.h"
#include "deploy/palpate/out_folder.h"
#include "deploy/palpate/plotter.h"
#include "deploy/palpate/progress.h"
#include "deploy/palpate/subcommands.h"
#include "deploy/palpate/viewers.h"
#include "deploy/palpate/virtual_session.h"

namespace palpate::deploy {
namespace {

struct SimulateOptions {
  std::string scene;
  std::vector<std::string> settings;
  std::string out;
  std::string device;
  std::string video;  // empty: none
  double seconds = 0;
  int threads = -1;
  bool no_pictures = false;
};

int simulate(SimulateOptions options) {
  if (options.threads >= 0) options.settings.push_back(fmt::format("physics.threads={}", options.threads));
  const Scene scene = load_scene(options.scene, options.settings);
  keep_as_private_as(files_of(scene));
  const std::filesystem::path out =
      options.out.empty() ? default_out(options.scene) : std::filesystem::path(options.out);
  const double seconds = options.seconds > 0 ? options.seconds : scene.natural_seconds();
  if (!options.video.empty()) require_film(options.video);
  VirtualSession session(scene, {options.device, !options.no_pictures});
  const HeldFolder held = prepare_out(out);
  install_stop_handlers();
  session.leave_in(out, source_of(scene, options.settings));
  const std::vector<std::string> known = session.remarks();
  for (const auto& remark : known) fmt::print(stderr, "palpate: {}\n", remark);
  Progress progress(seconds);
  session.run(seconds, [&](double t) { progress.show(t); });
  const nlohmann::json summary = session.finish();
  write_json((out / "summary.json").string(), summary);
  std::filesystem::remove(out / "parts");  // the nodes' folder, empty here
  draw_plots(out);
  fmt::print("{:.3f} s simulated in {:.2f} s ({:.2f} x real time), state {}\n",
             summary["simulated_s"].get<double>(), summary["wall_s"].get<double>(),
             summary["real_time_factor"].get<double>(), summary["state_hash"].get<std::string>());
  fmt::print("summary  {}\n", (out / "summary.json").string());
  if (std::filesystem::exists(out / "force.png")) fmt::print("plot     {}\n", (out / "force.png").string());
  export_for_viewers(out, scene);
  if (!options.no_pictures) fmt::print("pictures {}\n", (out / "frames").string());
  const bool filmed = options.video.empty() || make_film(out, summary, scene.render->rate_Hz, options.video);
  for (const std::string& text : warnings_of(summary))
    if (std::find(known.begin(), known.end(), text) == known.end()) fmt::print(stderr, "palpate: {}\n", text);
  const bool lost =
      summary.contains("render") && summary["render"].contains("frames_lost");  // said as it happened
  if (!summary["guard"].contains("stopped")) return lost || !filmed ? exit_failed : exit_ok;
  fmt::print(stderr, "palpate: {}\n", summary["guard"]["stopped"].get<std::string>());
  return exit_failed;
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command =
      app.add_subcommand("simulate", "run a scene in simulated time, in one process, deterministic");
  command->add_option("scene", options->scene, "scene file (TOML)")->required();
  command->add_option("--seconds", options->seconds, "simulated time [s]; else that of the scene")
      ->check(number_in(run_seconds));
  command->add_option("--out", options->out, "folder for the results (default out/SCENE)");
  command->add_option("--set", options->settings, "table.key=value over the scene; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--threads", options->threads, "threads of physics, 0: as many as pay")
      ->check(CLI::Range(0, 256));
  command->add_option("--device", options->device, "driver instead of the scene's");
  auto* no_frames = command->add_flag("--no-frames", options->no_pictures, "draw no pictures");
  command->add_option("--video", options->video, "film of the pictures, e.g. run.mp4; needs ffmpeg")
      ->excludes(no_frames);
  command->callback([options, &exit_code] { exit_code = simulate(*options); });
}

}  // namespace palpate::deploy
