#include "haptic_node/session.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/message/vec3.h"
#include "common/scene/device_spec.h"
#include "common/scene/force_model.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "common/time/clock.h"
#include "haptic_node/control/tell_motion.h"
#include "haptic_node/device/driver_library.h"
#include "haptic_node/device/driver_options.h"

namespace palpate::haptic {
namespace {

const DeviceSpec& spec_of(const Scene& scene, std::uint32_t tool_index) {
  PALPATE_CHECK(tool_index < scene.tools.size() && tool_index < max_tools, "a tool of the scene");
  return scene.device(scene.tools[tool_index].device);
}

std::string place_of(const DeviceSpec& spec) {
  return spec.place.file.empty() ? std::string() : spec.place.text();
}

std::string driver_of(const DeviceSpec& spec, const std::string& driver_override) {
  return driver_override.empty() ? spec.driver : driver_override;
}

/// Stiffness and force in the world that the device can bear. An input-only device gets no force.
ControllerSettings settings_of(const Scene& scene, std::uint32_t tool_index, const Calibration& calibration,
                               const hdev_info& info) {
  const ToolSpec& tool = scene.tools[tool_index];
  const DeviceSpec& spec = spec_of(scene, tool_index);
  ControllerSettings settings;
  settings.tool = tool_index;
  settings.period = 1.0 / spec.rate_Hz;
  settings.stiffness = tool.stiffness;
  settings.damping = tool.damping;
  settings.friction = tool.friction;
  if (tool.shape == ToolShape::forceps) settings.grip = tool.grip;
  if (info.max_stiffness > 0)
    settings.stiffness = std::min(tool.stiffness, info.max_stiffness / calibration.stiffness_gain());
  double limit = std::min(spec.force_limit, info.max_force);
  if (info.cont_force > 0) limit = std::min(limit, info.cont_force);
  if ((info.caps & HDEV_CAP_FORCE) == 0) limit = 0;
  settings.force_limit = limit / calibration.force_scale();
  if ((info.caps & HDEV_CAP_TORQUE) != 0 && (info.caps & HDEV_CAP_ROT) != 0) {
    double torque = info.max_torque * calibration.scale() / calibration.force_scale();
    if (info.cont_torque > 0)
      torque = std::min(torque, info.cont_torque * calibration.scale() / calibration.force_scale());
    settings.torque_limit = std::min(tool.torque_limit, torque);
  }
  settings.model = felt_force_model(tool, settings.torque_limit).model;
  if ((info.caps & HDEV_CAP_HW_WATCHDOG) != 0) settings.hold = info.hw_watchdog_s;
  settings.resolution = info.pos_resolution * calibration.scale();
  return settings;
}

Eigen::Matrix3d handle_rotation(const double (&r)[9]) {
  Eigen::Matrix3d m;
  m << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
  return m;
}

bool is_rotation(const Eigen::Matrix3d& R) {
  constexpr double tolerance = 1e-3;
  const double skew = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return skew <= tolerance && R.determinant() > 0;  // false for not a number
}

}  // namespace

HapticSession::HapticSession(const Scene& scene, std::uint32_t tool_index, const std::string& driver_override,
                             ClockFunction now_ns, void* user, Power power, int domain)
    : now_ns_(now_ns),
      user_(user),
      power_(power),
      rate_Hz_(spec_of(scene, tool_index).rate_Hz),
      calibration_(spec_of(scene, tool_index)),
      device_(DriverLibrary::load(driver_of(spec_of(scene, tool_index), driver_override),
                                  place_of(spec_of(scene, tool_index))),
              driver_options(spec_of(scene, tool_index), calibration_,
                             driver_of(spec_of(scene, tool_index), driver_override),
                             DriverPlace{scene.seed, tool_index, domain}),
              now_ns, user, place_of(spec_of(scene, tool_index))),
      controller_(settings_of(scene, tool_index, calibration_, device_.info())),
      force_model_(felt_force_model(scene.tools[tool_index], controller_.torque_limit())) {
  controller_.set_state(HapticState::ready);
  tool_state_.tool = tool_index;
  raw_.size = sizeof(hdev_state);
  start_ns_ = now_ns_(user_);
}

HapticSession::~HapticSession() { close(); }

void HapticSession::attach() noexcept { device_.rt_attach(); }

void HapticSession::go_on_from(const HapticSession& before) noexcept {
  before_ = counts_ = before.counts_;
  start_ns_ = before.start_ns_;
  first_run_ns_ = before.first_run_ns_;
}

double HapticSession::patch_age() const noexcept {
  const PatchWatch& patches = controller_.patches();
  return patches.ever() ? patches.silence(tool_state_.stamp_ns) : -1.0;
}

double HapticSession::sample_age() const noexcept {
  return read_once_ ? std::max(0.0, seconds_from_ns(tool_state_.stamp_ns - raw_.t_ns)) : 0.0;
}

hdev_status HapticSession::service() noexcept {
  if (!want_power_.exchange(false) || lost_.load()) return HDEV_E_AGAIN;
  stopped_by_us_.store(false);
  return device_.enable_force(true);
}

/// Motors that were on and are off, although nobody here has asked for it.
void HapticSession::look_after_power(DeviceSample& sample) noexcept {
  if (stopped_by_us_.load() || !device_.can(HDEV_CAP_FORCE)) {
    was_powered_ = false;
  } else if (sample.has_new) {
    if (was_powered_ && !sample.powered && sample.held && sample.trouble == FaultCause::none)
      sample.trouble = FaultCause::force_off;
    was_powered_ = sample.powered;
  }
}

/// @param ns  what read and write of a tick took together
FaultCause HapticSession::judge_calls(std::int64_t ns) noexcept {
  counts_.longest_call = std::max(counts_.longest_call, seconds_from_ns(ns));
  if (ns <= late_call_ns) {
    late_calls_ = 0;
    return FaultCause::none;
  }
  counts_.late_calls += 1;
  late_calls_ += 1;
  const bool held_up = late_calls_ >= late_calls_to_fault || ns > blocked_call_ns;
  return held_up ? FaultCause::blocked : FaultCause::none;
}

DeviceSample HapticSession::sample_device() noexcept {
  const std::int64_t before_ns = now_ns_(user_);
  const hdev_status status = device_.read(raw_);
  DeviceSample sample;
  sample.trouble = judge_calls(now_ns_(user_) - before_ns + write_ns_);
  write_ns_ = 0;
  sample.lost = status == HDEV_E_LOST;
  if (sample.lost) lost_.store(true);
  sample.fault = raw_.fault;
  if (status == HDEV_E_FAULT && sample.fault == 0) sample.fault = HDEV_FAULT_INTERNAL;
  sample.has_new = status == HDEV_OK && (!read_once_ || raw_.seq != seq_);
  if (sample.has_new) {
    read_once_ = true;
    seq_ = raw_.seq;
  }
  sample.t_ns = raw_.t_ns;
  sample.x = calibration_.world_from_device({raw_.pos[0], raw_.pos[1], raw_.pos[2]});
  if ((raw_.valid & HDEV_CAP_ROT) != 0) {
    const Eigen::Matrix3d R = handle_rotation(raw_.R);
    sample.is_rotation = is_rotation(R);
    if (sample.is_rotation) sample.q = Eigen::Quaterniond(calibration_.rotation() * R).normalized();
  }
  sample.powered = raw_.force_enabled != 0 || !device_.can(HDEV_CAP_FORCE);
  sample.held = raw_.deadman != 0 || !device_.can(HDEV_CAP_DEADMAN);
  sample.calibrated = raw_.cal == HDEV_CAL_OK;
  if ((raw_.valid & HDEV_CAP_TEMPERATURE) != 0) sample.temperature = temperature_ = raw_.temperature;
  if (temperature_ >= 1 && sample.trouble == FaultCause::none) sample.trouble = FaultCause::overtemp;
  counts_.temperature_max = std::max(counts_.temperature_max, temperature_);
  look_after_power(sample);
  return sample;
}

/// E += F . dx + M . turn, with what was held while the hand moved. What the motors really did.
void HapticSession::book_energy(const Vec3& x_d, const Eigen::Quaterniond& q_w) noexcept {
  if (counts_.ticks > before_.ticks && x_d.allFinite()) counts_.energy += force_d_.dot(x_d - last_x_d_);
  if (counts_.ticks > before_.ticks && !torque_w_.isZero())
    counts_.energy += torque_w_.dot(turn_between(last_q_, q_w));
  last_q_ = q_w;
  if (x_d.allFinite()) last_x_d_ = x_d;
  counts_.energy_max = std::max(counts_.energy_max, counts_.energy);
}

void HapticSession::write_force(const ControllerOutput& out) noexcept {
  force_d_ = out.write ? calibration_.force_to_device(out.force) : Vec3(Vec3::Zero());
  const Vec3 torque_d = out.write ? calibration_.torque_to_device(out.torque) : Vec3(Vec3::Zero());
  torque_w_ = calibration_.turned_to_world(torque_d);
  if (!out.write || !device_.can(HDEV_CAP_FORCE)) return;
  hdev_command command{};
  command.size = sizeof(hdev_command);
  for (int i = 0; i < 3; ++i) command.force[i] = force_d_(i), command.torque[i] = torque_d(i);
  const std::int64_t before_ns = now_ns_(user_);
  device_.write(command);
  write_ns_ = now_ns_(user_) - before_ns;
}

void HapticSession::fill_messages(std::int64_t now, const ControllerOutput& out) noexcept {
  const Vec3& x = controller_.motion().x();
  tool_state_.tick = counts_.ticks;
  tool_state_.stamp_ns = now;
  tool_state_.p_WT = array(x);
  tool_state_.v_WT = array(controller_.motion().v());
  const Eigen::Quaterniond& q = controller_.motion().q();
  tool_state_.q_WT = {q.w(), q.x(), q.y(), q.z()};
  if ((raw_.valid & HDEV_CAP_ANGVEL) != 0) {
    const Vec3 w = calibration_.turned_to_world({raw_.angvel[0], raw_.angvel[1], raw_.angvel[2]});
    if (w.allFinite()) tool_state_.w_WT = array(w);
  }
  tool_state_.proxy = array(out.proxy);
  tool_state_.force_on_hand = array(out.reported);
  tool_state_.force_now = array(out.force);
  tool_state_.torque_now = array(out.torque);
  tool_state_.contact_set = controller_.contact_set();
  tool_state_.buttons = raw_.buttons;
  tool_state_.engaged = controller_.engaged() ? 1u : 0u;
  tell_motion(controller_, tool_state_);

  trace_.tick = counts_.ticks;
  trace_.t = seconds_from_ns(now - start_ns_);
  trace_.p = tool_state_.p_WT;
  trace_.proxy = tool_state_.proxy;
  trace_.force = array(out.force);
  trace_.torque = array(out.torque);
  trace_.energy = counts_.energy;
}

void HapticSession::tick(const ContactPatch* newest, const ToolWrench* wrench) noexcept {
  if (!device_.is_open()) return;
  const std::int64_t now = now_ns_(user_);

  // 1. the hand; after a fault the device is left alone
  DeviceSample sample;
  if (state() != HapticState::fault) {
    sample = sample_device();
    book_energy({raw_.pos[0], raw_.pos[1], raw_.pos[2]}, sample.q);
  }

  // 2. the force
  const ControllerOutput out = controller_.tick(now, sample, newest, wrench);
  if (out.stop_motors) stop_motors();
  write_force(out);
  if (first_run_ns_ == 0 && state() == HapticState::run) first_run_ns_ = now;

  // 3. power, when the controller is ready for it
  if (out.want_power && !sample.powered) {
    want_power_.store(true);
    if (power_ == Power::by_tick) service();
  }

  // 4. what the others are told
  counts_.ticks += 1;
  counts_.stale_events = before_.stale_events + controller_.stale_events();
  counts_.safe_events = before_.safe_events + controller_.safe_events();
  counts_.faults = before_.faults + controller_.faults();
  counts_.patches_taken = before_.patches_taken + controller_.patches().taken();
  counts_.patches_rejected =
      before_.patches_rejected + controller_.patches().rejected() + controller_.wrenches().rejected();
  counts_.samples_rejected = before_.samples_rejected + controller_.motion().rejected();
  counts_.outran = before_.outran + controller_.outran();
  counts_.surplus = controller_.surplus();
  if (controller_.tissue() != nullptr) counts_.model_error = controller_.tissue()->model_error();
  counts_.surplus_max = std::max(counts_.surplus_max, counts_.surplus);
  if (out.write) {
    counts_.force_max = std::max(counts_.force_max, out.force.norm());
    counts_.torque_max = std::max(counts_.torque_max, out.torque.norm());
  }
  fill_messages(now, out);
}

void HapticSession::begin_close() noexcept {
  if (!device_.is_open()) return;
  stop_motors();
  device_.begin_close(state() != HapticState::fault);
  controller_.set_state(HapticState::off);
}

bool HapticSession::close() noexcept {
  begin_close();
  return device_.close();
}

}  // namespace palpate::haptic
