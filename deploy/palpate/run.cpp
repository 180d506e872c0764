// palpate run SCENE: starts the nodes, watches over them, and gathers what they leave.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/process/checked_option.h"
#include "common/process/command_line.h"
#include "common/process/stop_flag.h"
#include "common/report/json_file.h"
#include "common/scene/device_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/near_miss.h"
#include "common/scene/physics_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/scene_source.h"
#include "common/scene/tool_spec.h"
#include "deploy/palpate/disk_reserve.h"
#include "deploy/palpate/film.h"
#include "deploy/palpate/install_paths.h"
#include "deploy/palpate/nodes.h"
#include "deploy/palpate/out_folder.h"
#include "deploy/palpate/plotter.h"
#include "deploy/palpate/ports.h"
#include "deploy/palpate/session.h"
#include "deploy/palpate/subcommands.h"
#include "deploy/palpate/summary.h"
#include "deploy/palpate/viewers.h"
#include "haptic_node/device/driver_library.h"
#include "physics_node/forecast/memory_need.h"
#include "physics_node/record/catch_up.h"
#include "physics_node/record/mend_record.h"
#include "render_node/ui/window.h"

namespace palpate::deploy {
namespace fs = std::filesystem;

namespace {

struct RunOptions {
  std::string scene_path;
  std::vector<std::string> settings;
  std::string out;
  std::string device;
  std::string video;  // empty: none
  std::string deployment = "all";
  int side = 0;                      // of p2 and p3; 0: not given
  std::optional<std::string> nodes;  // nothing: as the deployment has it
  std::string interface;
  std::string peers;
  std::string bin;
  std::string from;  // a record to begin from; empty: the scene as it is loaded
  double at = std::numeric_limits<double>::infinity();  // where in it [s]; infinite: its end
  double seconds = 0;                                   // 0: the scene's own
  int domain = 0;
  bool headless = false;
  bool require_rt = false;
};

/// What every node is told; see common/process/node_main.h.
std::vector<std::string> node_arguments(const RunOptions& options, const fs::path& out) {
  std::vector<std::string> arguments = {options.scene_path, "--out", out.string(), "--domain",
                                        std::to_string(options.domain)};
  for (const auto& setting : options.settings) arguments.insert(arguments.end(), {"--set", setting});
  if (!options.device.empty()) arguments.insert(arguments.end(), {"--device", options.device});
  if (!options.from.empty()) arguments.insert(arguments.end(), {"--from", options.from});
  if (std::isfinite(options.at)) arguments.insert(arguments.end(), {"--at", fmt::format("{}", options.at)});
  if (options.headless) arguments.emplace_back("--headless");
  if (options.require_rt) arguments.emplace_back("--require-rt");
  if (!options.interface.empty()) arguments.insert(arguments.end(), {"--interface", options.interface});
  if (!options.peers.empty()) arguments.insert(arguments.end(), {"--peers", options.peers});
  return arguments;
}

void require_programs(const SessionPlan& plan) {
  for (const NodeKind node : plan.nodes) {
    const auto program = plan.bin / fmt::format("palpate-{}", name_of(node));
    if (!is_program(program))
      throw InputError(fmt::format("{}: no such program; build or install it", program.string()));
  }
}

const std::string& driver_of(const DeviceSpec& device, const RunOptions& options) {
  return options.device.empty() ? device.driver : options.device;
}

/// Does a person lead a tool with the mouse? Then no time of the scene's says when all is over.
bool any_pointed(const Scene& scene, const RunOptions& options) {
  return std::any_of(scene.tools.begin(), scene.tools.end(), [&](const ToolSpec& tool) {
    return driver_of(scene.device(tool.device), options) == "mouse";
  });
}

/// How long a session lasts: as told, else as the scene has it. With a window that is only said: a person closes it.
double session_seconds(const Scene& scene, const RunOptions& options, bool windowed) {
  if (options.seconds > 0) return options.seconds;
  return windowed && any_pointed(scene, options) ? std::numeric_limits<double>::infinity()
                                                 : scene.natural_seconds();
}

/// The haptic node would refuse an unknown driver, too, but only after all nodes have started.
void require_drivers(const Scene& scene, const RunOptions& options, const SessionPlan& plan) {
  if (std::find(plan.nodes.begin(), plan.nodes.end(), NodeKind::haptic) == plan.nodes.end()) return;
  const auto present = haptic::drivers_present(haptic::driver_folders());
  for (const ToolSpec& tool : scene.tools) {
    const DeviceSpec& device = scene.device(tool.device);
    const std::string& driver = driver_of(device, options);
    if (std::find(present.begin(), present.end(), driver) != present.end()) continue;
    const auto meant = near_miss(driver, present);
    throw InputError(fmt::format("{}: no driver \"{}\"; {}drivers here: {}",
                                 options.device.empty() ? device.place.text() : "--device", driver,
                                 meant ? fmt::format("did you mean \"{}\"? ", *meant) : "",
                                 present.empty() ? "none" : fmt::format("{}", fmt::join(present, ", "))));
  }
}

/// A record to begin from must be one, and outside the folder that this session writes to.
void require_record(const Scene& scene, const RunOptions& options, const fs::path& out, bool physics_here) {
  if (options.from.empty()) return;
  if (!physics_here) throw InputError("--from: begins where physics is, which is not on this PC");
  physics::time_in_record(options.from, options.at, 1 / scene.physics->frame_Hz);
  std::error_code ignored;
  if (fs::equivalent(out / "record.h5", options.from, ignored))
    throw InputError(fmt::format(
        "{}: holds the record that the session begins from; give another folder with --out", out.string()));
  keep_as_private_as({options.from});
}

/// A node that was killed has not closed its record. What cannot be mended is left as it is: palpate info says why.
void mend_left_record(const fs::path& record) {
  try {
    if (fs::exists(record) && physics::mend_record(record.string()))
      std::fprintf(stderr, "palpate: %s was cut short; palpate replay runs again what it holds\n",
                   record.c_str());
  } catch (const std::exception& damaged) {
    std::fprintf(stderr, "palpate: %s\n", damaged.what());
  }
}

void say_where(const fs::path& out, const fs::path& summary, bool plotted) {
  std::printf("summary  %s\n", summary.c_str());
  if (plotted && fs::exists(out / "force.png")) std::printf("plot     %s\n", (out / "force.png").c_str());
  std::error_code error;
  const auto pictures = std::distance(fs::directory_iterator(out / "frames", error), {});
  if (!error && pictures > 0) std::printf("frames   %s (%td)\n", (out / "frames").c_str(), pictures);
}

int run(const RunOptions& options) {
  // 1. everything that a person may have got wrong, before anything is started or written
  const Scene scene = load_scene(options.scene_path, options.settings);
  keep_as_private_as(files_of(scene));  // and so do the nodes
  const fs::path out = options.out.empty() ? default_out(options.scene_path) : fs::path(options.out);
  const Reach reach = {.interface = options.interface, .peers = comma_list(options.peers)};
  Share share = parse_share(options.deployment, options.side, options.nodes, !reach.local());
  if (scene.tools.empty()) share = without_hand(std::move(share));
  const bool physics_here =
      std::find(share.here.begin(), share.here.end(), NodeKind::physics) != share.here.end();
  require_record(scene, options, out, physics_here);
  if (physics_here) physics::refuse_too_large(scene, physics::usable_memory());
  const bool windowed = !options.headless && render::display_present() &&
                        std::find(share.here.begin(), share.here.end(), NodeKind::render) != share.here.end();
  std::optional<DiskReserve> room;
  const SessionPlan plan = {
      .nodes = share.here,
      .elsewhere = share.elsewhere,
      .bin = options.bin.empty() ? bin_folder() : fs::path(options.bin),
      .arguments = node_arguments(options, out),
      .membership = {.domain = options.domain,
                     .reach = reach,
                     .identity = own_identity("supervisor", scene.path, scene.checksum)},
      .seconds = session_seconds(scene, options, windowed),
      .simulated_too = options.seconds == 0,
      .until_closed = windowed && options.seconds == 0,
      .ending = [&room] { room.reset(); }};
  if (!options.video.empty()) {
    if (windowed || std::find(share.here.begin(), share.here.end(), NodeKind::render) == share.here.end())
      throw InputError("--video: makes a film of the pictures of a run without a window; add --headless");
    require_film(options.video);
  }
  require_programs(plan);
  require_drivers(scene, options, plan);
  resolve(reach);  // says what is wrong with it
  const bool alone = reach.local() && plan.elsewhere.empty();
  if (alone) require_free_ports(options.domain);
  const HeldFolder held = prepare_out(out);
  // Physics would take it for that of this session before it was started again.
  if (physics_here) fs::remove(out / "record.h5");
  room.emplace(out);

  // 2. the session
  install_stop_handlers();
  const SessionResult result = run_session(plan);

  // 3. what it leaves
  if (result.exit_code == exit_mistake) return exit_mistake;
  if (result.exit_code != exit_ok) mend_left_record(out / "record.h5");
  fs::path summary;
  try {
    summary = write_summary(out, scene, result);
  } catch (const std::runtime_error& error) {  // the folder was good when the session began: the disk is full
    std::fprintf(stderr, "palpate: %s\n", error.what());
    return exit_failed;
  }
  const bool plotted = !result.interrupted && draw_plots(out);
  say_where(out, summary, plotted);
  if (!result.interrupted) export_for_viewers(out, scene);
  const bool filmed = options.video.empty() ||
                      make_film(out, read_json(summary.string()), scene.render->rate_Hz, options.video);
  if (result.interrupted) std::printf("plot     palpate plot %s draws it\n", out.c_str());
  return filmed ? result.exit_code : exit_failed;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("run", "run a scene with all nodes, as processes of their own");
  auto options = std::make_shared<RunOptions>();
  command->add_option("scene", options->scene_path, "scene file (TOML)")->required();
  command->add_flag("--headless", options->headless, "pictures to files instead of a window");
  command
      ->add_option("--seconds", options->seconds,
                   "how long, once all nodes run; else until the window is closed, or without one until the "
                   "scene's length is simulated")
      ->check(number_in(run_seconds));
  command->add_option("--out", options->out, "folder for results (default: out/NAME_OF_SCENE)");
  auto* from = command->add_option(
      "--from", options->from,
      "record.h5 of an earlier run of this scene: the tissue begins as it was at its end");
  command->add_option("--at", options->at, "begin there in that record instead [s]")
      ->check(number_in(run_seconds))
      ->needs(from);
  command->add_option("--set", options->settings, "table.key=value over the scene; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--device", options->device, "driver instead of the scene's");
  command->add_option("--video", options->video,
                      "film of the pictures, e.g. run.mp4; needs ffmpeg and --headless");
  command->add_option("--deployment", options->deployment, "all: this PC; p2, p3: see docs/two_pcs.md")
      ->check(one_of({"all", "p2", "p3"}));
  command->add_option("--side", options->side, "which PC of p2 or p3 this is")->check(CLI::Range(1, 2));
  command->add_option("--nodes", options->nodes, "only some of physics,haptic,render");
  command->add_option("--interface", options->interface,
                      "network interface to the other PC, or its address; else this machine only");
  command->add_option("--peers", options->peers, "the other PC, by name or address; else multicast finds it");
  command
      ->add_option("--domain", options->domain, "DDS domain; sessions at the same time need different ones")
      ->check(CLI::Range(0, 100));
  command->add_flag("--require-rt", options->require_rt, "fail without real-time rights");
  command->add_option("--bin-dir", options->bin, "folder of the nodes' programs")->group("");  // for tests
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace palpate::deploy
