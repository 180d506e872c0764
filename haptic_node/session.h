#pragma once
// One tool in one hand: driver, calibration and controller behind one tick. No threads and no wire: the real-time
// loop calls it at the device's rate, `palpate simulate` calls it in simulated time. Both feel the same.

#include <atomic>
#include <cstdint>
#include <string>

#include "common/message/messages.h"
#include "common/scene/scene.h"
#include "haptic_node/control/controller.h"
#include "haptic_node/device/calibration.h"
#include "haptic_node/device/device.h"

namespace palpate::haptic {

/// What has happened so far.
struct SessionCounts {
  std::uint64_t ticks = 0;
  std::uint64_t stale_events = 0;  // patches stopped while forces were on
  std::uint64_t safe_events = 0;   // forces ramped down for a stall, an old sample, overspeed
  std::uint64_t faults = 0;        // of the device; each is latched until a person opens it anew
  std::uint64_t patches_taken = 0;
  std::uint64_t patches_rejected = 0;  // malformed, rejected whole; wrenches as well
  std::uint64_t samples_rejected = 0;  // of the device: not finite, or a jump
  std::uint64_t late_calls = 0;        // ticks in which the driver itself took longer than late_call_ns
  double longest_call = 0;             // of those read and write of one tick [s]
  double temperature_max = -1;         // of the motors, 1 = their limit; below 0: never told
  std::uint64_t outran = 0;            // ticks in which the tool was beyond what its patch covers
  double energy = 0;                   // given to the hand through the port so far [J]
  double energy_max = 0;               // largest of that [J]
  double surplus = 0;                  // of that, made out of nothing, now [J]
  double surplus_max = 0;              // largest of that [J]
  double force_max = 0;                // largest sent to the device, in the world [N]
  double torque_max = 0;               // likewise [N m]
};

class HapticSession {
 public:
  /// Who switches the motors on, which may block: tick() itself (simulated time), or service() on a slow thread.
  enum class Power { by_tick, by_service };

  /// Read and write of one tick together, beyond which the tick is late by the driver's fault. As long as a stall.
  static constexpr std::int64_t late_call_ns = 20'000'000;
  /// So many in a row, or one that takes a second, are a fault. Why: a process that somebody stopped for a moment while it was
  /// in the driver looks the same once; and nobody at the device waits longer than a second for a word.
  static constexpr int late_calls_to_fault = 3;
  static constexpr std::int64_t blocked_call_ns = 1'000'000'000;

  /// Opens the device of scene.tools[tool_index] and leaves it ready, forces off.
  /// @param driver_override  driver instead of the scene's; empty: the scene's
  /// @param now_ns, user     the clock [ns], called as now_ns(user) from all threads that call this session
  /// @param domain           DDS domain for drivers that hear others over it; below 0: none
  /// @throws InputError: no such driver, device or calibration
  HapticSession(const Scene& scene, std::uint32_t tool_index, const std::string& driver_override,
                ClockFunction now_ns, void* user, Power power = Power::by_tick, int domain = -1);
  ~HapticSession();
  HapticSession(const HapticSession&) = delete;
  HapticSession& operator=(const HapticSession&) = delete;

  /// Before the first tick: this session takes the place of one that has ended in a fault. Ticks, counts, energy and
  /// device time go on.
  void go_on_from(const HapticSession& before) noexcept;

  /// Once, on the thread that will tick, if that is a real-time one.
  void attach() noexcept;

  /// One tick at the clock's present time: read the hand, feel, write the force.
  /// Contract: real time; allocates, locks, prints and throws nothing (with Power::by_service).
  /// @param newest, wrench  the newest known, which may be those of the last tick; null: none yet
  void tick(const ContactPatch* newest, const ToolWrench* wrench = nullptr) noexcept;

  /// Another physics speaks from now on, and counts its ticks anew.
  void listen_anew() noexcept { controller_.listen_anew(); }

  /// With Power::by_service: switches the motors on when a tick has asked for it. Not the ticking thread.
  /// @return HDEV_E_AGAIN if nobody has asked, else what the driver answers
  hdev_status service() noexcept;

  /// Motors off now, from any thread and from signal handlers. A device that is lost is not called any more.
  void stop_motors() noexcept {
    stopped_by_us_.store(true);
    if (!lost_.load()) device_.stop();
  }

  /// Whether they are known to be off; the slow thread that owns this session.
  bool motors_off() const noexcept { return device_.motors_off(); }

  /// The process dies: motors off, from a signal handler on any thread. @return whether they are known to be off
  bool emergency_stop(std::uint32_t within_us) noexcept {
    return lost_.load() || device_.emergency_stop(within_us);
  }

  /// The force ramps to zero within 20 ms of further ticks; then stopped() is true.
  void begin_stop() noexcept { controller_.begin_stop(); }
  bool stopped() const noexcept { return controller_.stopped() || state() == HapticState::fault; }
  bool is_lost() const noexcept { return lost_.load(); }

  /// Zero force, motors off, device released: begins at once, in a thread of its own, as Device does.
  void begin_close() noexcept;
  /// Begins if need be, and waits. Safe to repeat; the destructor does it.
  /// @return false if the driver does not come back from it: the device is left to that thread
  bool close() noexcept;

  HapticState state() const noexcept { return controller_.state(); }
  FaultCause fault_cause() const noexcept { return controller_.fault_cause(); }
  /// What the driver says of its trouble. The slow thread that owns this session.
  std::string driver_words() const { return device_.last_words(); }
  /// Of the newest sample, 1 = the limit; below 0: unknown.
  double temperature() const noexcept { return temperature_; }
  /// Of the newest sample at the last tick [s]; 0 before the first one.
  double sample_age() const noexcept;
  const ToolState& tool_state() const noexcept { return tool_state_; }
  const TraceSample& trace() const noexcept { return trace_; }
  const SessionCounts& counts() const noexcept { return counts_; }
  const hdev_info& device_info() const noexcept { return device_.info(); }
  const Device& device() const noexcept { return device_; }
  /// Since the newest patch was accepted [s]; below 0: none yet.
  double patch_age() const noexcept;
  const Controller& controller() const noexcept { return controller_; }
  double rate_Hz() const noexcept { return rate_Hz_; }
  /// When forces were first on [ns of the clock]; 0: not yet. The simulated hand's path starts then.
  std::int64_t first_run_ns() const noexcept { return first_run_ns_; }

 private:
  DeviceSample sample_device() noexcept;
  void look_after_power(DeviceSample& sample) noexcept;
  FaultCause judge_calls(std::int64_t ns) noexcept;
  void write_force(const ControllerOutput& out) noexcept;
  void book_energy(const Vec3& x_d, const Eigen::Quaterniond& q_w) noexcept;
  void fill_messages(std::int64_t now, const ControllerOutput& out) noexcept;

  ClockFunction now_ns_;
  void* user_;
  Power power_;
  double rate_Hz_;
  Calibration calibration_;
  Device device_;
  Controller controller_;

  hdev_state raw_{};
  std::uint64_t seq_ = 0;
  bool read_once_ = false;
  Vec3 force_d_ = Vec3::Zero();   // now at the device [N], device frame
  Vec3 last_x_d_ = Vec3::Zero();  // [m], device frame
  Vec3 torque_w_ = Vec3::Zero();  // now at the device [N m], turned to the world
  Eigen::Quaterniond last_q_ = Eigen::Quaterniond::Identity();  // in the world
  std::atomic<bool> want_power_{false};
  std::atomic<bool> lost_{false};  // unplugged: only close() may be called
  std::atomic<bool> stopped_by_us_{true};  // whoever asked last for the motors wanted them off
  bool was_powered_ = false;               // since they were last asked for
  std::int64_t write_ns_ = 0;              // that the last write took
  int late_calls_ = 0;                     // in a row
  double temperature_ = -1;
  std::int64_t start_ns_ = 0;
  std::int64_t first_run_ns_ = 0;
  ToolState tool_state_{};
  TraceSample trace_{};
  SessionCounts counts_;
  SessionCounts before_;  // of the sessions that this one goes on from
};

}  // namespace palpate::haptic
