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
  void service() noexcept;

  /// Motors off now, from any thread and from signal handlers. A device that is lost is not called any more.
  void stop_motors() noexcept {
    if (!lost_.load()) device_.stop();
  }

  /// The process dies: motors off, from a signal handler on any thread. @return whether they are known to be off
  bool emergency_stop(std::uint32_t within_us) noexcept {
    return lost_.load() || device_.emergency_stop(within_us);
  }

  /// The force ramps to zero within 20 ms of further ticks; then stopped() is true.
  void begin_stop() noexcept { controller_.begin_stop(); }
  bool stopped() const noexcept { return controller_.stopped() || state() == HapticState::fault; }
  bool is_lost() const noexcept { return lost_.load(); }

  /// Zero force, motors off, device released. Safe to repeat; the destructor does it.
  void close() noexcept;

  HapticState state() const noexcept { return controller_.state(); }
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
  std::int64_t start_ns_ = 0;
  std::int64_t first_run_ns_ = 0;
  ToolState tool_state_{};
  TraceSample trace_{};
  SessionCounts counts_;
  SessionCounts before_;  // of the sessions that this one goes on from
};

}  // namespace palpate::haptic
