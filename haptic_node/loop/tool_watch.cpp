#include "haptic_node/loop/tool_watch.h"

#include <fmt/format.h>

#include "common/report/log.h"
#include "common/time/clock.h"

namespace palpate::haptic {
namespace {

double percent(double share) { return 100.0 * share; }

}  // namespace

/// What is known of the motors is said with it: the driver has a moment to switch them off.
void ToolWatch::begin_fault(FaultCause cause, double t, const std::string& words) {
  open_fault_ = FaultRecord{channel_.name, t, cause, words};
  fault_since_ = Clock::now();
  look_at_motors();
}

/// Nobody knows it of a session that is not here.
bool ToolWatch::motors_off() const {
  const HapticSession* session = channel_.session.get();
  return session != nullptr && session->motors_off();
}

void ToolWatch::look_at_motors() {
  if (open_fault_) {
    const bool off = motors_off();
    if (off || Clock::now() - fault_since_ > Device::off_within) say_fault(off);
  } else if (fault_.may_force && motors_off()) {
    fault_.may_force = false;
    said_.warn(fmt::format("{}: its motors are off now", channel_.name));
  }
}

void ToolWatch::say_fault(bool off) {
  fault_ = *open_fault_;
  fault_.may_force = !off;
  open_fault_.reset();
  const std::string said = fault_.words.empty() ? std::string() : fmt::format(" ({})", fault_.words);
  said_.error(fmt::format("{}: fault: {}{}; {}; {}, then `palpate reset {}` opens it anew", channel_.name,
                          text_of(fault_.cause), said, off ? "forces are off" : motors_may_be_on,
                          advice_of(fault_.cause), channel_.name));
  if (records_.size() < most_records) records_.push_back(fault_);
}

/// Once each: warm motors stay warm for minutes.
void ToolWatch::say_heat() {
  const double gain = report_.thermal_gain, heat = percent(report_.temperature);
  if (gain < 1 && !said_warm_) {
    said_warm_ = true;
    said_.warn(fmt::format(
        "{}: its motors are at {:.0f} % of their limit; the force goes down to nothing at {:.0f} %",
        channel_.name, heat, percent(ThermalLimit::hot)));
  }
  if (gain <= 0 && !said_hot_) {
    said_hot_ = true;
    said_.warn(
        fmt::format("{}: no force, since its motors are at {:.0f} % of their limit; let them cool down",
                    channel_.name, heat));
  }
  if (gain >= 1) said_warm_ = said_hot_ = false;
}

/// What the driver says, if the session is here and not being opened anew.
std::string ToolWatch::words() const {
  const HapticSession* session = channel_.session.get();
  return session == nullptr ? std::string() : session->driver_words();
}

/// Once each time: no fault, since whoever moves the device may come back.
void ToolWatch::say_silence() {
  const bool silent = report_.sample_age > silence_s;
  if (silent && !silent_) {
    silence_words_ = words();
    said_.warn(fmt::format("{}: nothing new from the device for {:.0f} s{}{}; no force until it is back",
                           channel_.name, report_.sample_age, silence_words_.empty() ? "" : ": ",
                           silence_words_));
  }
  silent_ = silent;
}

void ToolWatch::look_at_power(hdev_status answer) {
  if (answer == HDEV_E_AGAIN) return;
  const bool refused = answer != HDEV_OK;
  if (refused && !power_refused_)
    said_.warn(fmt::format("{}: its motors do not switch on: {}", channel_.name, words()));
  power_refused_ = refused;
}

void ToolWatch::look(double t) {
  look_at_motors();
  const SessionReport* newest = channel_.reports.newest();
  if (newest == nullptr) return;
  const bool fault = newest->state == HapticState::fault && report_.state != HapticState::fault;
  const bool first = newest->first_run_ns > 0 && report_.first_run_ns == 0;
  report_ = *newest;
  if (first) log_info("{}: forces are on", channel_.name);
  say_force_model();
  if (report_.counts.late_calls > 0 && !said_late_ && !fault) {
    said_late_ = true;
    said_.warn(fmt::format(
        "{}: its driver held up a tick for {:.0f} ms; forces begin anew after that (said once, counted as "
        "late_calls)",
        channel_.name, 1e3 * report_.counts.longest_call));
  }
  if (fault && !stuck_) {
    begin_fault(report_.cause, t, words());
  } else if (report_.state != HapticState::fault) {
    say_heat();
    say_silence();
  }
}

/// A device that is opened anew may be another one.
void ToolWatch::say_force_model() {
  const std::string line = warning_of(report_.force_model);
  if (!line.empty() && !said_model_) said_.warn(fmt::format("{}: {}", channel_.name, line));
  said_model_ = !line.empty();
}

void ToolWatch::look_at_call(std::int64_t ns, double t) {
  if (ns > stuck_ns && !stuck_) {
    stuck_ = true;
    begin_fault(FaultCause::blocked, t, fmt::format("no answer for {:.1f} s", seconds_from_ns(ns)));
  }
  if (ns == 0 && report_.state != HapticState::fault) stuck_ = false;
}

std::string ToolWatch::why_no_force() const {
  if (silent_)
    return fmt::format("nothing new from the device{}{}", silence_words_.empty() ? "" : ": ", silence_words_);
  if (report_.state == HapticState::armed && power_refused_) return "its motors do not switch on";
  const bool waits = report_.state == HapticState::ready || report_.state == HapticState::safe;
  return waits ? text_of(report_.refusal) : "";
}

std::string ToolWatch::note(bool opening) const {
  const std::string& name = channel_.name;
  if (opening) return name + ": opening";
  if (failed()) {
    const FaultCause cause = stuck_ ? FaultCause::blocked : report_.cause;
    if (!open_fault_ && fault_.may_force)
      return fmt::format("{}: {} ({})", name, motors_may_be_on, text_of(cause));
    return fmt::format("{}: fault: {}; {}, palpate reset {}", name, text_of(cause), advice_of(cause), name);
  }
  std::string note = fmt::format("{}: {}", name, name_of(report_.state));
  if (const std::string why = why_no_force(); !why.empty()) note += fmt::format(" ({})", why);
  if (report_.thermal_gain < 1)
    note += fmt::format(" (motors at {:.0f} % of their limit, {:.0f} % of the force)",
                        percent(report_.temperature), percent(report_.thermal_gain));
  return note;
}

}  // namespace palpate::haptic
