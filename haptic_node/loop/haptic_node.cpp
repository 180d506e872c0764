#include "haptic_node/loop/haptic_node.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "common/error/error.h"
#include "common/process/stop_flag.h"
#include "common/report/log.h"
#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "common/time/clock.h"
#include "common/wire/refusals.h"
#include "haptic_node/loop/haptic_summary.h"

namespace palpate::haptic {
namespace {

using namespace std::chrono_literals;
constexpr std::int64_t status_period_ns = 200'000'000;  // 5 Hz

/// All tools are ticked by one loop.
double common_rate(const Scene& scene) {
  if (scene.tools.empty()) throw InputError(scene.path + ": no [[tool]]; the haptic node needs one");
  const double rate = scene.device(scene.tools.front().device).rate_Hz;
  for (const auto& tool : scene.tools) {
    const DeviceSpec& device = scene.device(tool.device);
    if (device.rate_Hz != rate)
      throw InputError(
          fmt::format("{}: [device.{}] runs at {} Hz and another at {} Hz; give all devices one rate_Hz",
                      device.place.text(), device.name, device.rate_Hz, rate));
  }
  return rate;
}

}  // namespace

HapticNode::HapticNode(const NodeOptions& options, const Scene& scene)
    : options_(options), scene_(scene), rate_Hz_(common_rate(scene)) {
  set_log_name("haptic");
  ask_for_rights();
  Membership nobody = membership(options, scene, "haptic");
  nobody.identity = {};
  first_ = std::make_unique<Participant>(nobody);
  newcomer_ = std::make_unique<Newcomer>(*first_, membership(options, scene, "haptic").identity);
  newcomer_->settle();  // before a device is opened: it may be another hand's
  calls_ = std::make_unique<CallWatch>([this] {
    for (const auto& channel : channels_)
      if (HapticSession* session = channel->session.get()) session->stop_motors();
  });
  for (std::uint32_t tool = 0; tool < scene.tools.size(); ++tool) {
    const CallWatch::Call call(*calls_, scene.tools[tool].name + ": opening its device");
    channels_.push_back(std::make_unique<ToolChannel>(scene, tool, options.device, options.domain));
    const HapticSession& session = *channels_.back()->session.get();
    const hdev_info& info = session.device_info();
    log_info("{}: {} ({}), up to {:.1f} N, force model {}", scene.tools[tool].name, info.model, info.vendor,
             session.controller().force_limit(), words_of(session.force_model()));
    resets_.emplace_back(*channels_.back(), [this, tool] {
      return open_session(scene_, tool, options_.device, options_.domain);
    });
  }
  set_guard();
  for (const auto& channel : channels_) tools_.emplace_back(*channel, said_);
  flights_.resize(channels_.size());
  wire_ = std::make_unique<Wire>(membership(options, scene, "haptic"), channels_);
  loop_ = std::make_unique<RealtimeLoop>(channels_, rate_Hz_);
  loop_watch_ = std::make_unique<LoopWatch>(*loop_, rate_Hz_, said_);
  status_.node = NodeKind::haptic;
  status_.pid = static_cast<std::uint32_t>(getpid());
  status_.scene_checksum = scene_.checksum;
}

void HapticNode::ask_for_rights() {
  std::string why_not_locked, why_not_scheduled;
  rights_.locked = lock_memory(why_not_locked);
  rights_.scheduled = may_schedule(RealtimeLoop::watchdog_priority, why_not_scheduled);
  std::vector<std::string> lacks;
  for (const auto& why : {why_not_locked, why_not_scheduled})
    if (!why.empty()) lacks.push_back(why);
  if (options_.require_rt && !lacks.empty()) throw InputError(lacks);
  for (const auto& why : lacks) log_warn("{}", why);
}

/// Before motors are on for the first time.
void HapticNode::set_guard() {
  std::vector<const RescueWords*> tools;
  for (const auto& channel : channels_) {
    const Device& device = channel->session.get()->device();
    tools.push_back(device.can_be_rescued() ? &device.rescue_words() : nullptr);
  }
  guardian_ = std::make_unique<Guardian>(std::move(tools));
  crash_stop_ = std::make_unique<CrashStop>(channels_, *guardian_);
}

/// Motors are switched on here, not in the real-time thread, as drivers may take their time.
void HapticNode::serve() {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const CallWatch::Call call(*calls_, channels_[i]->name + ": switching its motors");
    if (HapticSession* session = channels_[i]->session.get(); session != nullptr && !CrashStop::ending())
      tools_[i].look_at_power(session->service());
    const FaultCause said = tools_[i].said_fault() ? tools_[i].report().cause : FaultCause::none;
    resets_[i].step(tools_[i].report().state, said);
  }
}

/// OUT/flight_TOOL.csv, flight_TOOL_2.csv, ...: as many as a person may want to look at.
void HapticNode::keep_flights() {
  constexpr int most = 9;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (options_.out.empty() || flights_[i] >= most || !channels_[i]->flight.has_kept()) continue;
    flights_[i] += 1;
    const std::string number = flights_[i] == 1 ? std::string() : fmt::format("_{}", flights_[i]);
    const std::string path = fmt::format("{}/flight_{}{}.csv", options_.out, channels_[i]->name, number);
    try {
      channels_[i]->flight.write_kept(path);
      log_info("{}: its last seconds are in {}", channels_[i]->name, path);
    } catch (const InputError& error) {
      log_error("{}", error.what());
    }
  }
}

double HapticNode::seconds_so_far() const {
  const LoopStats* stats = loop_->stats();
  return stats == nullptr ? 0.0 : seconds_from_ns(now_ns() - stats->start_ns);
}

void HapticNode::look_at_tools() {
  const std::int64_t now = now_ns();
  loop_watch_->look(now);
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const CallWatch::Call call(*calls_, channels_[i]->name + ": asking for the cause of its fault");
    tools_[i].look(seconds_so_far());
    tools_[i].look_at_call(loop_watch_->in_driver_ns(static_cast<int>(i), now), seconds_so_far());
  }
}

bool HapticNode::is_over() const {
  if (stop_requested() || wire_->stop_commanded()) return true;
  if (options_.seconds <= 0) return false;
  return std::all_of(tools_.begin(), tools_.end(), [this](const ToolWatch& tool) {
    const std::int64_t first_ns = tool.report().first_run_ns;
    return first_ns > 0 && seconds_from_ns(now_ns() - first_ns) >= options_.seconds;
  });
}

std::string HapticNode::note() const {
  std::string note = rights_text(rights_);
  for (std::size_t i = 0; i < tools_.size(); ++i) note += "; " + tools_[i].note(resets_[i].busy());
  if (const std::string slow = loop_watch_->note(); !slow.empty()) note += "; " + slow;
  note.resize(std::min(note.size(), status_.note.size() - 1));
  return note;
}

/// What loop, tools and wire have counted so far.
void HapticNode::take_counts(std::int64_t now) {
  status_.warnings = 0;
  status_.rate_Hz = loop_watch_->measure(now);
  status_.real_time_factor = status_.rate_Hz / rate_Hz_;
  if (const LoopStats* stats = loop_->stats()) {
    status_.t = seconds_from_ns(now - stats->start_ns);
    status_.ticks = stats->ticks;
    status_.late = stats->skipped;
    status_.lateness = stats->lateness;
    status_.loop_age_ms_p50 = stats->loop_age.percentile(0.5);
    status_.warnings += static_cast<std::uint32_t>(stats->watchdog_stops);
  }
  SessionCounts sum;
  for (const auto& tool : tools_) {
    const SessionCounts& counts = tool.report().counts;
    sum.stale_events += counts.stale_events;
    sum.safe_events += counts.safe_events;
    sum.faults += counts.faults;
    sum.energy = std::max(sum.energy, counts.energy);
    sum.surplus = std::max(sum.surplus, counts.surplus);
  }
  status_.energy_J = sum.energy;
  status_.surplus_J = sum.surplus;
  status_.stale_events = static_cast<std::uint32_t>(sum.stale_events);
  status_.safe_events = static_cast<std::uint32_t>(sum.safe_events);
  status_.faults = static_cast<std::uint32_t>(sum.faults);
  status_.warnings += status_.stale_events + status_.safe_events;
  const Wire::HeardCounts heard = wire_->heard();
  clear_counts(status_);
  for (const ReaderCounts& counts : {heard.patches, heard.wrenches, wire_->commands_heard()})
    add_counts(status_, counts);
  status_.samples_received = heard.patches.received;
  status_.samples_lost = heard.patches.lost;
  status_.warnings += status_.refused[0] == '\0' ? 0 : 1;
}

void HapticNode::publish_status(NodePhase phase) {
  const bool failed =
      std::any_of(tools_.begin(), tools_.end(), [](const ToolWatch& tool) { return tool.failed(); });
  status_.phase = failed ? NodePhase::failed : phase;
  take_counts(now_ns());
  const std::string text = note();
  status_.note.fill('\0');
  std::copy(text.begin(), text.end(), status_.note.begin());
  wire_->write_status(status_);
  for (const auto& line : wire_->remarks()) log_warn("{}", line);
}

int HapticNode::run() {
  log_info("{:.0f} Hz, {}", rate_Hz_, rights_text(rights_));
  wire_->start();
  loop_->start();
  std::int64_t next_status = 0;
  // 1. state of the tools, power, resets, flights  2. status
  while (!unwelcome_ && !is_over()) {
    std::this_thread::sleep_for(2ms);
    look_at_tools();
    serve();
    keep_flights();
    if (now_ns() < next_status) continue;
    next_status = now_ns() + status_period_ns;
    const bool running = std::all_of(tools_.begin(), tools_.end(),
                                     [](const ToolWatch& tool) { return tool.report().first_run_ns > 0; });
    publish_status(running ? NodePhase::running : NodePhase::ready);
    unwelcome_ = newcomer_->must_go();
    guardian_->look_after();
  }
  return leave();
}

/// All at once. A session that the loop holds in a driver that hangs cannot be closed.
/// @return whether all are closed
bool HapticNode::close_devices() {
  bool closed = true;
  std::vector<std::unique_ptr<HapticSession>> sessions(channels_.size());
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    closed = closed && !resets_[i].hangs();
    channels_[i]->flight.end();
    if (resets_[i].has_session()) {
      if (!resets_[i].hangs()) guardian_->off(i);
      continue;
    }
    const HapticSession* session = channels_[i]->session.get();
    sessions[i] = channels_[i]->session.take_back();
    if (sessions[i] != nullptr) {
      sessions[i]->stop_motors();
    } else {
      log_error("{}: its driver does not come back from a tick; the device is left as it is{}",
                channels_[i]->name,
                session == nullptr || session->motors_off() ? "" : std::string(": ") + motors_may_be_on);
      closed = false;
    }
  }
  for (const auto& session : sessions)
    if (session != nullptr) session->begin_close();
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    if (sessions[i] == nullptr) continue;
    const bool off = sessions[i]->close();
    if (off) guardian_->off(i);
    closed = closed && off;
  }
  return closed;
}

/// Forces to zero first, then the motors, then what is told about it.
int HapticNode::leave() {
  const bool loop_ended = loop_->finish();
  look_at_tools();
  const bool closed = close_devices();
  keep_flights();
  wire_->finish();
  publish_status(NodePhase::stopping);
  bool kept = true;
  try {
    const LoopStats* stats = loop_->stats();
    if (!options_.out.empty())
      write_haptic_summary(options_.out, stats == nullptr ? LoopStats() : *stats, tools_, said_.lines(),
                           *wire_);
  } catch (const std::runtime_error& error) {  // a disk that has filled up is nobody's mistake
    log_error("{}", error.what());
    kept = false;
  }
  if (!loop_ended || !closed) leave_behind(exit_failed);
  if (unwelcome_) return exit_mistake;
  const bool faulty =
      std::any_of(tools_.begin(), tools_.end(), [](const ToolWatch& tool) { return tool.failed(); });
  return faulty || !kept ? exit_failed : exit_ok;
}

/// A thread that hangs in a driver still uses what the destructors would take away. The session hears of the end as ever.
void HapticNode::leave_behind(int code) {
  newcomer_.reset();
  wire_.reset();
  first_.reset();
  std::fflush(nullptr);
  std::_Exit(code);
}

}  // namespace palpate::haptic
