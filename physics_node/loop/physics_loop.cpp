#include "physics_node/loop/physics_loop.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "common/error/error.h"
#include "common/message/tissue_reset.h"
#include "common/process/stop_flag.h"
#include "common/report/json_file.h"
#include "common/report/log.h"
#include "common/scene/device_spec.h"
#include "common/scene/inside_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "common/time/clock.h"
#include "common/time/histogram.h"
#include "common/time/ticker.h"
#include "common/wire/heard_report.h"
#include "common/wire/refusals.h"
#include "common/wire/wire_report.h"
#include "physics_node/record/catch_up.h"
#include "physics_node/record/earlier_record.h"
#include "physics_node/remarks/remarks.h"
#include "physics_node/report/physics_summary.h"

namespace palpate::physics {
namespace {

constexpr int most_steps = 10000;  // that physics goes on by while it is paused
constexpr int most_commands = 64;  // a frame; what is more waits
// Where frames and hand have one rate, frames are led to begin just after the hand has spoken, so that nothing waits for a
// frame: a little earlier each time it had, later when it had not. One frame in 21 then begins too early.
constexpr std::int64_t earlier_ns = 1'000;
constexpr std::int64_t later_ns = 20'000;
constexpr int cores_of_the_hand = 1;                    // that the team leaves, where the scene has a tool
constexpr std::int64_t eye_period_ns = 33'000'000;      // vertex blocks at 30 Hz
constexpr std::int64_t status_period_ns = 200'000'000;  // 5 Hz
// For each of two things done before leaving. Why: a hurried session kills after 700 ms.
constexpr auto last_look = std::chrono::milliseconds(100);

}  // namespace

PhysicsLoop::PhysicsLoop(const NodeOptions& options, const Scene& scene)
    : options_(options),
      scene_(scene),
      wire_(membership(options, scene, "physics")),
      hands_(scene.tools.size()) {
  set_log_name("physics");
  status_.node = NodeKind::physics;
  status_.pid = static_cast<std::uint32_t>(getpid());
  status_.scene_checksum = scene.checksum;
  publish_status(NodePhase::loading);

  const std::int64_t begin = now_ns();
  world_ = std::make_unique<World>(scene_, scene_.tools.empty() ? 0 : cores_of_the_hand);
  world_->add_remarks(remarks_about(*world_));
  appearance_ = std::make_unique<Appearance>(*world_, scene_.render->threshold, Remake::beside);
  newcomer_
      .settle();  // before an earlier record is set aside, and before the hand and the eye are told anything
  if (!options_.out.empty()) {
    std::filesystem::create_directories(options_.out + "/parts");
    if (const auto aside = set_earlier_record_aside(options_.out))
      log_warn("the record of an earlier session is now {}", aside->string());
    recorder_ = std::make_unique<Recorder>(*world_, source_of(scene_, options_.settings), options_.out,
                                           Recorder::WhenBehind::drop);
  }
  Index masses = 0;
  for (std::size_t b = 0; b < world_->n_bodies(); ++b) masses += world_->body(b).body().n_nodes();
  log_info(
      "{} masses, step {:.3f} ms of at most {:.3f}, {} thread(s) at most, {} visible facets, loaded in "
      "{:.2f} s",
      masses, 1e3 * world_->step_seconds(), 1e3 * world_->stable_step_seconds(), world_->threads(),
      appearance_->facets_visible(), seconds_from_ns(now_ns() - begin));
  for (const auto& remark : world_->remarks()) {
    log_warn("{}", remark);
    note(remark);
  }
  if (!options_.from.empty()) go_on_from_record();
}

/// Nobody hears of the tissue meanwhile, and what people say waits.
void PhysicsLoop::go_on_from_record() {
  const std::int64_t begin = now_ns();
  log_info("running {} again{}", options_.from,
           std::isinf(options_.at) ? "" : fmt::format(" to {:.6g} s", options_.at));
  if (recorder_) recorder_->set_when_behind(Recorder::WhenBehind::wait);
  const CaughtUp caught_up =
      catch_up(options_.from, options_.at, *world_, recorder_.get(), [] { return !stop_requested(); });
  if (recorder_) recorder_->set_when_behind(Recorder::WhenBehind::drop);
  began_t_ = last_status_t_ = caught_up.t;
  last_status_frames_ = world_->report().frames;
  log_info("{:.3f} s run again in {:.2f} s, {} states as recorded{}", caught_up.t,
           seconds_from_ns(now_ns() - begin), caught_up.compared,
           stop_requested() ? "; told to stop" : "; the session goes on from there");
}

/// @return true if the hand has spoken since the last frame
bool PhysicsLoop::take_tools() {
  ToolState state;
  bool any = false;
  while (wire_.tool_states.take(state)) {
    if (const auto changes = wire_.hand.changes(); changes != hand_changes_) {
      hand_changes_ = changes;
      hands_.begin_anew();
    }
    any = hands_.take(state, now_ns()) || any;
  }
  return any;
}

/// What was asked for several times is done once: whoever asks without end shall not hold up the tissue.
void PhysicsLoop::take_commands() {
  Command command;
  bool reset = false, undo = false;
  double steps = 0;
  std::optional<double> threshold;
  std::optional<std::optional<SectionSpec>> section;
  std::optional<ColourKind> colour;
  std::optional<std::optional<double>> inside;
  for (int n = 0; n < most_commands && wire_.commands.take(command); ++n) {
    if (recorder_) recorder_->command(*world_, command);
    switch (command.kind) {
      case CommandKind::pause:
        paused_ = true;
        steps += command.value;
        break;
      case CommandKind::resume:
        paused_ = false;
        steps = frames_to_go_ = 0;
        break;
      case CommandKind::reset:
        (is_undo(command) ? undo : reset) = true;
        break;
      case CommandKind::threshold:
        threshold = command.value;
        break;
      case CommandKind::section:
        section = section_of(command.name.data(), command.value);
        break;
      case CommandKind::colour:
        if (const auto kind = colour_kind_of(command.name.data())) colour = kind;
        break;
      case CommandKind::inside:
        inside = inside_of(command.name.data(), command.value);
        break;
      case CommandKind::stop:
        stop_ = true;
        break;
      case CommandKind::record:
      case CommandKind::material:
        if (!unheeded_) log_warn("a command that this version does not carry out was ignored");
        unheeded_ = true;
        break;
      case CommandKind::device:
        break;  // the hand's
    }
  }
  if (steps > 0)
    frames_to_go_ =
        static_cast<int>(std::min(frames_to_go_ + std::floor(steps), static_cast<double>(most_steps)));
  if (undo && !world_->undo()) {
    constexpr std::string_view why =
        "nothing to undo: no blade has cut since the start, a reset or the last undo";
    log_warn("{}", why);
    note(why);
  }
  if (reset) world_->reset();
  if (threshold) appearance_->set_threshold(*threshold);
  if (section) appearance_->set_section(*section);
  if (inside) appearance_->set_inside(*inside);
  if (colour) appearance_->set_colour(*colour);
}

void PhysicsLoop::publish_hand() {
  const auto frame = static_cast<std::uint64_t>(world_->report().frames);
  for (std::size_t n = 0; n < world_->n_tools(); ++n) {
    Tool& tool = world_->tool(n);
    // The patch last: it wakes the hand, which then finds both.
    tool.write_wrench(wrench_, frame, now_ns(), world_->t());
    wire_.wrenches.write(wrench_);
    tool.write_patch(patch_, frame, now_ns());
    wire_.patches.write(patch_);
  }
}

void PhysicsLoop::publish_eye() {
  for (const std::uint32_t body : wire_.eye.take_incomplete()) appearance_->publish_anew(body);
  const bool anew = appearance_->poll();
  publish_blocks();  // first: whoever gets a new surface then knows already where it is
  if (anew)
    appearance_->write_surfaces({[this](const BodySurface& chunk) { wire_.eye.post(chunk); },
                                 [this](const SurfaceChange& page) { wire_.eye.post(page); }});
}

void PhysicsLoop::publish_blocks() {
  const std::uint64_t ever = wire_.eye.watchers_ever();  // one that came as another left counts as well
  if (ever > watchers_ever_) appearance_->resend();
  watchers_ever_ = ever;
  if (wire_.eye.watchers() == 0) {
    ++world_->report()[Stage::publish].skipped;
    return;
  }
  const StageTimer timer(world_->report(), Stage::publish);
  appearance_->write_blocks([this](const VertexBlock& block) { wire_.eye.post(block); });
}

/// A warning is logged once, when it comes up; the window shows the newest.
void PhysicsLoop::tell_warnings() {
  const WarningKinds raised = raised_warnings(*world_);
  for (const std::string& text : warning_texts(*world_, raised & ~known_warnings_)) {
    log_warn("{}", text);
    note(text);
  }
  known_warnings_ |= raised;
  status_.warnings = static_cast<std::uint32_t>(world_->remarks().size() + known_warnings_.count());
}

void PhysicsLoop::note(std::string_view text) {
  status_.note.fill('\0');
  std::copy_n(text.begin(), std::min(text.size(), status_.note.size() - 1), status_.note.begin());
}

void PhysicsLoop::publish_status(NodePhase phase) {
  const std::int64_t now = now_ns();
  status_.phase = phase;
  if (world_) {
    const double wall = seconds_from_ns(now - last_status_ns_);
    status_.t = world_->t();
    status_.ticks = static_cast<std::uint64_t>(world_->report().frames);
    if (last_status_ns_ > 0 && wall > 0) {
      status_.rate_Hz = static_cast<double>(world_->report().frames - last_status_frames_) / wall;
      status_.real_time_factor = (world_->t() - last_status_t_) / wall;
    }
    tell_warnings();
    last_status_t_ = world_->t();
    last_status_frames_ = world_->report().frames;
  }
  clear_counts(status_);
  add_counts(status_, wire_.tool_states.counts());
  add_counts(status_, wire_.commands.counts());
  status_.samples_lost = hands_.samples_lost();
  status_.rejected[static_cast<std::size_t>(RejectReason::out_of_range)] += hands_.ticks_rejected();
  status_.warnings += status_.refused[0] == '\0' ? 0 : 1;
  for (Speaker* speaker : {&wire_.hand, &wire_.people})
    for (const auto& line : speaker->remarks()) log_warn("{}", line);
  last_status_ns_ = now;
  if (recorder_) recorder_->status(status_);
  wire_.status.write(status_);
}

int PhysicsLoop::run() {
  Ticker ticker(scene_.physics->frame_Hz);
  start_ns_ = now_ns();
  std::int64_t next_eye = start_ns_;
  std::int64_t next_status = start_ns_;
  const bool in_step =
      !scene_.tools.empty() && scene_.device(scene_.tools.front().device).rate_Hz == scene_.physics->frame_Hz;
  // 1. wait  2. hear  3. move  4. tell the hand  5. tell the eye, the record and whoever asks
  while (!stop_ && !stop_requested() && (options_.seconds <= 0 || world_->t() < options_.seconds)) {
    const auto wake = ticker.wait();
    status_.late += wake.skipped;
    ++status_.lateness[octave_bin((wake.woke_ns - wake.due_ns) / 1000, histogram_bins)];
    take_commands();
    const bool heard = take_tools();
    const auto fresh = hands_.at(now_ns());
    if (in_step && hands_.any()) ticker.shift(heard ? -earlier_ns : later_ns);
    const bool moves = !paused_ || frames_to_go_ > 0;
    if (paused_ && moves) --frames_to_go_;
    if (moves) world_->frame(fresh);
    if (world_->has_stopped()) break;  // no answer is better than one from a world that stands still
    publish_hand();
    if (recorder_ && moves) recorder_->frame(*world_, fresh);
    const std::int64_t now = now_ns();
    if (now >= next_eye) {
      publish_eye();
      next_eye = now + eye_period_ns;
    }
    if (recorder_ && recorder_->failed() && !record_failed_) {
      record_failed_ = true;
      log_error("the record can no longer be written; the session goes on without it");
    }
    if (now >= next_status) {
      publish_status(NodePhase::running);
      next_status = now + status_period_ns;
      if (newcomer_.must_go()) stop_ = unwelcome_ = true;
    }
  }
  const bool left = leave();
  if (unwelcome_) return exit_mistake;
  if (!world_->has_stopped()) return left ? exit_ok : exit_failed;
  log_error("{}", *world_->stopped());
  return exit_failed;
}

/// @return false if something of the record was lost
bool PhysicsLoop::leave() {
  appearance_->settle(last_look);
  publish_eye();
  wire_.eye.drain(last_look);
  publish_status(world_->has_stopped() ? NodePhase::failed : NodePhase::stopping);
  const double wall = seconds_from_ns(now_ns() - start_ns_);
  if (!recorder_) return true;
  bool left = true;
  const auto try_to = [&left](const auto& write) {
    try {
      write();
    } catch (const std::runtime_error& lost) {  // InputError, too: the disk is full, or the folder is gone
      log_error("not all was recorded: {}", lost.what());
      left = false;
    }
  };
  try_to([&] { recorder_->finish(*world_); });
  auto part = physics_summary(*world_, recorder_.get(), wall, began_t_);
  part.update(wire_report("physics", wire_.participant, wire_.patches, wire_.wrenches, wire_.status,
                          wire_.eye.surfaces(), wire_.eye.changes(), wire_.eye.blocks()));
  part.update(surface_bytes_report(appearance_->surface_bytes()));
  add_heard(part, "physics",
            {{"ToolState", wire_.tool_states.counts()}, {"Command", wire_.commands.counts()}});
  try_to([&] { write_json(options_.out + "/parts/physics.json", part); });
  return left;
}

}  // namespace palpate::physics
