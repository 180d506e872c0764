#pragma once
// What the slow thread makes of the reports of one tool: each new trouble in one line with its cause, once; what the status
// says of the tool now; and what the summary keeps.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "haptic_node/loop/said.h"
#include "haptic_node/loop/tool_channel.h"

namespace palpate::haptic {

/// A latched fault, for the summary.
struct FaultRecord {
  std::string tool;
  double t = 0;  // since the loop began [s]
  FaultCause cause = FaultCause::none;
  std::string words;       // of the driver; empty: it says nothing
  bool may_force = false;  // its motors could not be shown to be off
};

class ToolWatch {
 public:
  static constexpr std::size_t most_records = 32;
  /// A device that was heard of and has had nothing new for so long has gone, or has nobody who moves it. [s]
  static constexpr double silence_s = 1;
  /// The thread of the loop has been in the driver for so long: told at once, it may never come back.
  static constexpr std::int64_t stuck_ns = 1'000'000'000;

  /// @param channel, said  outlive this
  ToolWatch(ToolChannel& channel, Said& said) : channel_(channel), said_(said) {}

  /// Every few milliseconds. Takes the newest report, says what is new.
  /// @param t  since the loop began [s]
  void look(double t);

  /// What the driver has answered to the motors' switch; HDEV_E_AGAIN: nobody has asked.
  void look_at_power(hdev_status answer);

  /// The loop is in this tool's driver and has not come back for `ns`; 0: it has, or is elsewhere.
  void look_at_call(std::int64_t ns, double t);

  const std::string& tool() const noexcept { return channel_.name; }
  const SessionReport& report() const noexcept { return report_; }
  bool stuck() const noexcept { return stuck_; }
  /// The fault that there is has been said, with what is known of the motors.
  bool said_fault() const noexcept { return failed() && !open_fault_; }
  bool failed() const noexcept { return stuck_ || report_.state == HapticState::fault; }
  const std::vector<FaultRecord>& records() const noexcept { return records_; }

  /// "tip: run", "tip: ready (inside the tissue, move out)", "tip: fault: its motors are too warm; let it cool down, then ..."
  std::string note(bool opening) const;

 private:
  using Clock = std::chrono::steady_clock;
  void begin_fault(FaultCause cause, double t, const std::string& words);
  void look_at_motors();
  void say_fault(bool off);
  bool motors_off() const;
  void say_force_model();
  void say_heat();
  void say_silence();
  std::string words() const;
  std::string why_no_force() const;

  ToolChannel& channel_;
  Said& said_;
  SessionReport report_;
  bool stuck_ = false;
  std::optional<FaultRecord> open_fault_;  // not said yet: its motors are being switched off
  FaultRecord fault_;                      // the newest one
  Clock::time_point fault_since_;
  bool said_model_ = false, said_late_ = false, said_warm_ = false, said_hot_ = false;
  bool silent_ = false, power_refused_ = false;
  std::string silence_words_;
  std::vector<FaultRecord> records_;
};

}  // namespace palpate::haptic
