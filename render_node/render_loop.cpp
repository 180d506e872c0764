#include "render_node/render_loop.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/error/error.h"
#include "common/message/tissue_reset.h"
#include "common/process/stop_flag.h"
#include "common/report/json_file.h"
#include "common/report/log.h"
#include "common/scene/device_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "common/time/clock.h"
#include "common/wire/heard_report.h"
#include "render_node/eye_pace.h"
#include "render_node/frame_schedule.h"
#include "render_node/gl/egl_context.h"
#include "render_node/image/frame_folder.h"
#include "render_node/image/screenshot.h"
#include "render_node/model/hand_state.h"
#include "render_node/picture.h"
#include "render_node/ui/window.h"
#include "render_node/wire.h"

namespace palpate::render {
namespace {

constexpr int niceness = 5;  // the hand and the tissue go first
constexpr double status_period_s = 0.25;
constexpr auto nap = std::chrono::milliseconds(5);

// How the eye fares, for NodeStatus and the report.
class Fare {
 public:
  explicit Fare(const Scene& scene) {
    status_.node = NodeKind::render;
    status_.pid = static_cast<std::uint32_t>(getpid());
    status_.scene_checksum = scene.checksum;
  }
  void drew(double t) {
    if (frames_ == 0) first_ns_ = now_ns();
    ++frames_;
    status_.t = t;
    last_ns_ = now_ns();
  }
  void note_losses(const FrameFolder& frames) {
    status_.warnings = frames.lost() > 0 ? 1 : 0;
    lost_ = frames.lost();
    const std::string note = lost_ > 0 ? fmt::format("{} pictures lost: {}", lost_, frames.why()) : "";
    status_.note.fill('\0');
    std::copy_n(note.begin(), std::min(note.size(), status_.note.size() - 1), status_.note.begin());
  }
  void tell(Wire& wire, NodePhase phase, std::uint64_t skipped, bool at_once) {
    const double since = seconds_from_ns(now_ns() - told_ns_);
    if (!at_once && since < status_period_s) return;
    status_.phase = phase;
    status_.rate_Hz = static_cast<double>(frames_ - status_.ticks) / since;
    status_.ticks = frames_;
    status_.late = skipped;
    told_ns_ = now_ns();
    wire.tell(status_);
  }
  /// @return exit code: nothing that was to be kept may be missing
  int write_report(const std::string& out, const ViewModel& model, Wire& wire,
                   const FrameFolder* frames) const {
    const double seconds = seconds_from_ns(last_ns_ - first_ns_);
    const auto folder = std::filesystem::path(out) / "parts";
    std::error_code already;  // write_json says what is wrong with the folder
    std::filesystem::create_directories(folder, already);
    nlohmann::json report = {{"frames", frames_},
                             {"facets_visible", model.facets_visible()},
                             {"facets_total", model.facets_total()}};
    if (frames_ > 1 && seconds > 0) report["fps"] = static_cast<double>(frames_ - 1) / seconds;
    if (frames != nullptr) {
      report["frames"] = frames->kept();
      if (frames->lost() > 0) report["frames_lost"] = frames->lost();
      if (frames->every() > 1)
        report.update({{"frames_left_out", frames->left_out()}, {"frames_every", frames->every()}});
    }
    nlohmann::json part = {{"render", report}};
    add_heard(part, "render", wire.heard());
    try {
      write_json((folder / "render.json").string(), part);
    } catch (const std::runtime_error& error) {
      log_error("{}", error.what());
      return exit_failed;
    }
    return lost_ > 0 ? exit_failed : exit_ok;
  }

 private:
  NodeStatus status_;
  std::uint64_t frames_ = 0, lost_ = 0;
  std::int64_t told_ns_ = now_ns(), first_ns_ = 0, last_ns_ = 0;
};

NodePhase phase_of(const ViewModel& model) {
  return model.anything_to_see() ? NodePhase::running : NodePhase::ready;
}

bool time_is_over(const NodeOptions& options, const ViewModel& model) {
  return options.seconds > 0 && model.t() >= options.seconds;
}

/// Tools whose device is the mouse in our window.
std::vector<std::uint32_t> pointed_tools(const NodeOptions& options, const Scene& scene) {
  std::vector<std::uint32_t> tools;
  for (std::uint32_t i = 0; i < scene.tools.size(); ++i) {
    const std::string& driver =
        options.device.empty() ? scene.device(scene.tools[i].device).driver : options.device;
    if (driver == "mouse") tools.push_back(i);
  }
  return tools;
}

/// Hand and tissue want a core each. Before there is a context: Mesa's software renderer takes every core otherwise.
void spare_cores() {
  if (few_cores()) setenv("LP_NUM_THREADS", "1", 0);
}

int run_headless(const NodeOptions& options, const Scene& scene) {
  FrameFolder frames(options.out, *scene.render);
  spare_cores();
  Wire wire(membership(options, scene, "render"));
  Fare fare(scene);
  fare.tell(wire, NodePhase::loading, 0, true);
  Picture picture(scene, few_cores() ? Edges::plain : Edges::smooth);
  FrameSchedule schedule(scene.render->rate_Hz);
  if (!pointed_tools(options, scene).empty())
    log_warn("driver \"mouse\": there is no window to point in; leave out --headless, on a display");
  bool stop = false;
  while (!stop && !wire.unwelcome() && !stop_requested() && !time_is_over(options, picture.model())) {
    // 1. take what has come
    const auto news = wire.take_into(picture.model());
    stop = news.stop;
    if (news.threshold) picture.set_threshold(*news.threshold);
    if (news.section) picture.set_section(*news.section);
    if (news.inside) picture.set_inside(*news.inside);
    if (news.colour) picture.set_colour(*news.colour);
    // 2. draw when simulated time has come to the next frame
    const double t = picture.model().t();
    if (picture.model().anything_to_see() && schedule.due(t) && frames.wants_next()) {
      picture.draw(t);
      fare.drew(t);
      frames.keep(picture.image());
      fare.note_losses(frames);
    } else {
      std::this_thread::sleep_for(nap);
    }
    // 3. say how it goes
    fare.tell(wire, phase_of(picture.model()), schedule.skipped(), false);
  }
  wire.take_into(picture.model());  // physics, which is told to end first, may have said its last meanwhile
  frames.settle();
  fare.note_losses(frames);
  fare.tell(wire, NodePhase::stopping, schedule.skipped(), true);
  const int kept = fare.write_report(options.out, picture.model(), wire, &frames);
  return wire.unwelcome() ? exit_mistake : kept;
}

/// A reset is of the tissue, and of each device at fault, as `palpate reset` does it.
void reset(const Scene& scene, const ViewModel& model, Wire& wire) {
  wire.command(CommandKind::reset);
  const auto& hand = model.node(NodeKind::haptic);
  for (const ToolSpec& tool : scene.tools)
    if (hand && hand_state(hand->note.data(), tool.name).state == "fault")
      wire.command(CommandKind::device, 1, tool.name);
}

/// @return words for the person
std::string keep(const Image& picture, const std::string& out) {
  try {
    return "saved " + save_screenshot(picture, out.empty() ? "." : out);
  } catch (const InputError& error) {
    log_warn("{}", error.what());
    return error.what();
  }
}

void pass_on(const PanelWishes& wishes, bool paused, double frame_Hz, Window& window, Wire& wire) {
  const double hundredth = std::max(1.0, std::round(0.01 * frame_Hz));
  const double frames = wishes.frames_on + hundredth * wishes.hundredths_on;
  if (frames > 0)
    wire.command(CommandKind::pause, frames);
  else if (wishes.paused != paused)
    wire.command(wishes.paused ? CommandKind::pause : CommandKind::resume);
  const double now_s = seconds_from_ns(now_ns());
  if (const auto value = window.threshold().due(now_s, wishes.threshold_released))
    wire.command(CommandKind::threshold, *value);
  if (window.section().due(now_s, wishes.section_released)) {
    const auto& section = window.section().value();
    wire.command(CommandKind::section, section ? section->at : 0, std::string(section_name(section)));
  }
  if (window.inside().due(now_s, wishes.inside_released)) {
    const auto from = window.inside().value();
    wire.command(CommandKind::inside, from.value_or(0), std::string(inside_name(from)));
  }
}

/// The scene with the driver that the command line wants: another than the scene's follows no path of its.
Scene with_driver(Scene scene, const std::string& driver) {
  if (driver.empty()) return scene;
  for (DeviceSpec& device : scene.devices) {
    if (device.driver != driver) device.waypoints.clear();
    device.driver = driver;
  }
  return scene;
}

int run_window(const NodeOptions& options, const Scene& given) {
  const Scene scene = with_driver(given, options.device);
  spare_cores();
  ViewModel model(scene);
  Window window(scene, model, pointed_tools(options, scene));
  Wire wire(membership(options, scene, "render"));
  Fare fare(scene);
  EyePace pace(window.software());
  ColourKind commanded = window.colour();
  bool stop = false;
  while (!stop && !wire.unwelcome() && !stop_requested() && !time_is_over(options, model)) {
    const std::int64_t began_ns = now_ns();
    // 1. take what has come
    const auto news = wire.take_into(model);
    stop = news.stop;
    if (news.threshold) window.threshold().obey(*news.threshold);
    if (news.section) window.section().obey(*news.section);
    if (news.inside) window.inside().obey(*news.inside);
    if (news.colour) window.colour() = commanded = *news.colour;
    // 2. draw, and pass on what the person wants
    PanelFacts facts;
    facts.t = model.t();
    facts.interactive = true;
    facts.paused = news.paused;
    const PanelWishes wishes = window.draw(facts);
    pass_on(wishes, facts.paused, scene.physics->frame_Hz, window, wire);
    if (window.colour() != commanded) {
      commanded = window.colour();
      wire.command(CommandKind::colour, 0, std::string(name_of(commanded)));
    }
    if (wishes.reset) reset(scene, model, wire);
    if (wishes.undo) wire.command(CommandKind::reset, 0, std::string(last_stroke));
    if (wishes.picture) window.say(keep(*wishes.picture, options.out));
    for (auto& pointer : window.pointers()) wire.point(pointer.message(now_ns()));
    fare.drew(model.t());
    if (window.closing()) {
      wire.command(CommandKind::stop);
      break;
    }
    // 3. say how it goes
    fare.tell(wire, phase_of(model), 0, false);
    // 4. leave the processor to others
    if (const auto& physics = model.node(NodeKind::physics)) pace.hear(*physics);
    const double rest_s = pace.rest_s(seconds_from_ns(now_ns() - began_ns));
    if (rest_s > 0) std::this_thread::sleep_for(std::chrono::duration<double>(rest_s));
  }
  fare.tell(wire, NodePhase::stopping, 0, true);
  const int kept = options.out.empty() ? exit_ok : fare.write_report(options.out, model, wire, nullptr);
  return wire.unwelcome() ? exit_mistake : kept;
}

}  // namespace

int run_render(const NodeOptions& options, const Scene& scene) {
  set_log_name("render");
  if (nice(niceness) == -1) log_warn("could not step back behind the other nodes");
  const bool windowed = !options.headless && display_present();
  return windowed ? run_window(options, scene) : run_headless(options, scene);
}

}  // namespace palpate::render
