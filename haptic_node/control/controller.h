#pragma once
// From a device sample and the newest patch to the force of this tick. No device, no wire, no thread, no clock of its
// own: the same object runs in the real-time loop and in simulated time.
//
//   off -> open -> calibrating -> ready --(patch, outside the tissue, hand at rest)--> armed --(motors on)--> run
//   run --(patches stop)--> stale --(patches return)--> run, or ready once the force has faded to nothing
//   any --(stall, old samples, overspeed, motors off, let go)--> safe --(quiet again)--> ready
//   any --(device lost, faulty or blocked, three impossible samples)--> fault, for good: a person opens the device anew

#include <cstdint>

#include "common/math/vec3.h"
#include "common/message/messages.h"
#include "common/scene/kinds.h"
#include "haptic_node/contact/local_model.h"
#include "haptic_node/control/answer_watch.h"
#include "haptic_node/control/force_report.h"
#include "haptic_node/control/motion_watch.h"
#include "haptic_node/safety/energy_limit.h"
#include "haptic_node/safety/force_guard.h"
#include "haptic_node/safety/thermal_limit.h"

namespace palpate::haptic {

enum class HapticState : std::uint32_t { off, open, calibrating, ready, armed, run, stale, safe, fault };
const char* name_of(HapticState state) noexcept;

/// Why forces are not switched on in the states `ready` and `safe`.
enum class ArmRefusal : std::uint32_t { none, no_sample, not_calibrated, not_held, no_patch, inside, moving };
const char* text_of(ArmRefusal refusal) noexcept;

struct ControllerSettings {
  std::uint32_t tool = 0;
  ForceModel model = ForceModel::norton;
  double period = 1e-3;     // nominal time between ticks [s]
  double stiffness = 400;   // of the hand spring, in the world [N/m]
  double damping = 1;       // [N s/m]
  double friction = 0;      // Coulomb's coefficient of the surface, where planes are felt
  double grip = 0;          // of a tool that holds tissue; 0: it only pushes [N]
  double force_limit = 3;   // in the world [N]
  double torque_limit = 0;  // in the world; 0: the device gives none [N m]
  double resolution = 0;    // of a sample, in the world [m]
  double hold = 0;  // silence after which the device has dropped its force by itself; 0: it never does [s]
};

struct ControllerOutput {
  Vec3 force = Vec3::Zero();     // on the hand [N]
  Vec3 torque = Vec3::Zero();    // on the hand, about the tip [N m]
  Vec3 reported = Vec3::Zero();  // the same for physics, low-passed [N]
  Vec3 proxy = Vec3::Zero();     // [m]
  bool write = true;             // false: the device is not to be written to any more
  bool want_power = false;       // motors should be on
  bool stop_motors = false;      // now, by the device's stop(); once
};

class Controller {
 public:
  static constexpr double stall = 20e-3;       // between ticks, beyond which forces start anew [s]
  static constexpr double safe_ramp = 20e-3;   // to no force [s]
  static constexpr double safe_rest = 0.1;     // without trouble before forces may come back [s]
  static constexpr double arming_speed = 0.1;  // [m/s]
  static constexpr double arm_ramp = 0.5;      // to the whole force after arming, from outside the tissue [s]

  explicit Controller(const ControllerSettings& settings) noexcept;

  /// The device is being opened, calibrated, is ready; before the first tick.
  void set_state(HapticState state) noexcept { state_ = state; }

  /// Contract: real time. Every call counts as one tick at `now_ns`.
  /// @param patch, wrench  newest known, which may be old ones, or null; only what the model needs is looked at
  ControllerOutput tick(std::int64_t now_ns, const DeviceSample& sample, const ContactPatch* patch,
                        const ToolWrench* wrench = nullptr) noexcept;

  /// Another physics speaks from now on, and counts its ticks anew.
  void listen_anew() noexcept {
    patches_.listen_anew();
    wrenches_.listen_anew();
  }

  /// Forces ramp to zero within safe_ramp and stay there.
  /// @param ramps  false: with the next tick
  void begin_stop(bool ramps = true) noexcept {
    stopping_ = true;
    if (!ramps) stop_gain_ = 0;
  }
  bool stopped() const noexcept { return stopping_ && stop_gain_ <= 0; }

  HapticState state() const noexcept { return state_; }
  ArmRefusal refusal() const noexcept { return refusal_; }
  FaultCause fault_cause() const noexcept { return fault_cause_; }
  /// What warm motors leave of the force, 0 to 1.
  double thermal_gain() const noexcept { return thermal_.gain(); }
  bool engaged() const noexcept { return state_ == HapticState::run || state_ == HapticState::stale; }
  const MotionWatch& motion() const noexcept { return motion_; }
  const PatchWatch& patches() const noexcept { return patches_; }
  const WrenchWatch& wrenches() const noexcept { return wrenches_; }
  bool needs_wrench() const noexcept { return model_.needs_wrench(); }
  bool is_passive() const noexcept { return model_.is_passive(); }
  const ContactResult& contact() const noexcept { return felt_; }
  double plane_work() const noexcept { return model_.work(); }
  /// In the springs as they are applied: limited, faded [J].
  double stored() const noexcept { return stored_; }
  /// Energy that the loop has generated, as seen from the samples [J].
  double surplus() const noexcept { return model_.limits_itself() ? model_.surplus() : energy_.surplus(); }
  /// Of a hand whose motion presses tissue: what it was felt with. Its samples count ticks.
  const PointTouch* tissue() const noexcept { return model_.limits_itself() ? &model_.tissue() : nullptr; }
  const ControllerSettings& settings() const noexcept { return settings_; }
  double force_limit() const noexcept { return guard_.limit(); }
  double torque_limit() const noexcept { return torque_guard_.limit(); }
  std::uint64_t contact_set() const noexcept { return contact_set_; }

  std::uint64_t stale_events() const noexcept { return stale_events_; }
  std::uint64_t safe_events() const noexcept { return safe_events_; }
  std::uint64_t faults() const noexcept { return faults_; }
  std::uint64_t outran() const noexcept { return outran_; }

 private:
  ControllerOutput faulted(FaultCause first) noexcept;
  void enter_safe(bool may_resume_inside) noexcept;
  void look_for_trouble(MotionVerdict verdict, const DeviceSample& sample, double dt) noexcept;
  void step_state(std::int64_t now_ns, const DeviceSample& sample, bool new_patch) noexcept;
  ArmRefusal why_not(std::int64_t now_ns, const DeviceSample& sample) const noexcept;
  void step_ready(std::int64_t now_ns, const DeviceSample& sample) noexcept;
  void step_run() noexcept;
  void step_stale(std::int64_t now_ns, bool new_patch) noexcept;
  void step_safe(std::int64_t now_ns, const DeviceSample& sample) noexcept;
  double share_of_felt() noexcept;
  double hand_moved() noexcept;
  /// Of what the springs would push with: fade or ramp, the end of the session, warm motors.
  double whole_gain() const noexcept { return gain_ * stop_gain_ * thermal_.gain(); }
  bool take_answer(std::int64_t now_ns, const ContactPatch* patch, const ToolWrench* wrench) noexcept;
  /// What the silence of physics leaves of the force.
  double freshness(std::int64_t now_ns) const noexcept {
    return model_.needs_wrench() ? wrenches_.gain(now_ns) : patches_.gain(now_ns);
  }

  ControllerSettings settings_;
  MotionWatch motion_;
  PatchWatch patches_;
  WrenchWatch wrenches_;
  LocalModel model_;
  ForceGuard guard_;
  ForceGuard torque_guard_;
  ForceReport report_;
  EnergyLimit energy_;
  ThermalLimit thermal_;
  ContactResult felt_;
  double full_ = 0;    // in the springs at full gain [J]
  double stored_ = 0;  // as they are applied [J]

  HapticState state_ = HapticState::off;
  ArmRefusal refusal_ = ArmRefusal::no_sample;
  FaultCause fault_cause_ = FaultCause::none;
  bool resume_inside_ = false;  // after a stall: planes start at the hand, no need to leave the tissue first
  double safe_for_ = 0;         // since the last trouble [s]
  double reached_ = 1;          // of the force felt in the last tick, after all limits
  double gain_ = 1;             // of the state: fade or ramp
  bool stopping_ = false;
  double stop_gain_ = 1;
  Vec3 x_before_ = Vec3::Zero();  // of the hand, a tick ago [m]
  Eigen::Quaterniond q_before_ = Eigen::Quaterniond::Identity();
  std::int64_t last_ns_ = 0;
  bool ticked_ = false;
  std::uint64_t contact_set_ = 0;
  std::uint64_t stale_events_ = 0, safe_events_ = 0, faults_ = 0, outran_ = 0;
};

}  // namespace palpate::haptic
