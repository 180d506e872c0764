#include "haptic_node/drivers/openhaptics/hd_device.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <thread>

#include "haptic_node/drivers/kit/emergency.h"
#include "haptic_node/drivers/openhaptics/hd_calibration.h"
#include "haptic_node/drivers/openhaptics/hd_errors.h"

namespace palpate::haptic::openhaptics {
namespace {

constexpr double mm = 1e-3;    // [m]
constexpr double mN_m = 1e-3;  // [N m]
constexpr std::size_t most_motors = 8;

double one_double(const Hd& hd, HDenum what) {
  std::array<double, 16> values{};
  hd.get_doubles(what, values.data());
  return values[0];
}

int one_integer(const Hd& hd, HDenum what) {
  std::array<int, 16> values{};
  hd.get_integers(what, values.data());
  return values[0];
}

template <std::size_t N>
void copy_text(char (&to)[N], const char* from) {
  std::snprintf(to, N, "%s", from == nullptr ? "" : from);
}

}  // namespace

HdDevice::HdDevice(const hdev_host& host, const Hd& hd, const std::string& name, unsigned long rate_Hz)
    : OpenDevice(host), hd_(hd), rate_Hz_(rate_Hz), stopper_(hd) {
  heard_ns_ = now_ns();
  open_scheduled(hd_, name, rate_Hz, frame, this, prepare, scheduled_);
}

/// Motors first: by the next frame, or without it. Whoever waits for a scheduler that is dead or hangs waits for ever, so that
/// this comes before libHD is asked to stop it.
HdDevice::~HdDevice() {
  stop();
  kit::comes_true([this] { return motors_are_off(); }, static_cast<std::uint32_t>(dead_ns / 1000));
  leave_alone_.store(true);
  close_scheduled(hd_, scheduled_, [this] {
    if (stopper_.has_disabled_device()) return false;
    if (stopper_.take_zero_owed()) {  // nobody else is in the library now
      hd_.begin_frame(scheduled_.device);
      set_effort({});
      hd_.end_frame(scheduled_.device);
    }
    return true;
  });
}

void HdDevice::prepare(void* self) {
  auto& device = *static_cast<HdDevice*>(self);
  const Hd& hd = device.hd_;
  device.stopper_.watch(device.scheduled_.device);
  hd.disable(HD_FORCE_OUTPUT);
  hd.enable(HD_MAX_FORCE_CLAMPING);
  hd.enable(HD_FORCE_RAMPING);

  hdev_info& info = device.info_;
  copy_text(info.vendor, hd.get_string(HD_DEVICE_VENDOR));
  copy_text(info.model, hd.get_string(HD_DEVICE_MODEL_TYPE));
  copy_text(info.serial, hd.get_string(HD_DEVICE_SERIAL_NUMBER));
  copy_text(info.sdk_version, hd.get_string(HD_VERSION));
  info.dof_in = static_cast<std::uint32_t>(std::max(one_integer(hd, HD_INPUT_DOF), 0));
  info.dof_out = static_cast<std::uint32_t>(std::max(one_integer(hd, HD_OUTPUT_DOF), 0));
  info.n_buttons = 4;
  info.caps = HDEV_CAP_POS | HDEV_CAP_VEL | HDEV_CAP_FORCE | HDEV_CAP_TEMPERATURE | HDEV_CAP_REL_ENCODERS;
  if (info.dof_in >= 6) info.caps |= HDEV_CAP_ROT | HDEV_CAP_ANGVEL;
  std::array<double, 16> box{};
  hd.get_doubles(HD_USABLE_WORKSPACE_DIMENSIONS, box.data());
  for (std::size_t i = 0; i < 3; ++i) {
    info.ws_min[i] = box[i] * mm;
    info.ws_max[i] = box[i + 3] * mm;
  }
  info.max_force = one_double(hd, HD_NOMINAL_MAX_FORCE);
  info.cont_force = one_double(hd, HD_NOMINAL_MAX_CONTINUOUS_FORCE);
  info.max_stiffness = one_double(hd, HD_NOMINAL_MAX_STIFFNESS) / mm;
  if (info.dof_out >= 6) {
    info.caps |= HDEV_CAP_TORQUE;
    info.max_torque = one_double(hd, HD_NOMINAL_MAX_TORQUE_FORCE) * mN_m;
  }
  info.nominal_rate_hz = static_cast<double>(device.rate_Hz_);
  info.io_latency_s = 1.0 / info.nominal_rate_hz;
  if (const HDErrorInfo error = hd.get_error(); error.code != HD_SUCCESS)
    throw kit::Trouble(HDEV_E_NODEV, "the device does not say what it is: " + words_of(hd, error));
}

void HdDevice::calibrate(std::uint32_t timeout_ms) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(timeout_ms);
  CalibrationLook look{&hd_, scheduled_.device};
  bool told = false;
  while (true) {
    hd_.schedule_synchronous(look_at_calibration, &look, HD_DEFAULT_SCHEDULER_PRIORITY);
    if (look.found == HD_CALIBRATION_OK) break;
    const bool user = look.found == HD_CALIBRATION_NEEDS_MANUAL_INPUT;
    calibration_.store(user ? HDEV_CAL_NEEDS_USER : HDEV_CAL_RUNNING);
    if (user && !told) log(1, std::string("not calibrated; ") + calibration_advice(look.style));
    told = told || user;
    if (std::chrono::steady_clock::now() >= end)
      throw kit::Trouble(HDEV_E_NOTCAL, fmt::format("still not calibrated after {} ms; {}", timeout_ms,
                                                    calibration_advice(look.style)));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  calibration_.store(HDEV_CAL_OK);
}

void HdDevice::power(bool on) {
  if (lost_.load()) throw kit::Trouble(HDEV_E_LOST, last_words());
  if (on && calibration_.load() != HDEV_CAL_OK)
    throw kit::Trouble(HDEV_E_NOTCAL, "forces stay off until the device is calibrated");
  if (!on) return static_cast<void>(stop());
  wanted_.store(true);
}

std::string HdDevice::last_words() const {
  if (dead_.load())
    return fmt::format("the scheduler of libHD has not called back for {} ms", dead_ns / 1'000'000);
  if (dropped_.load() && fault_code_.load() == HD_SUCCESS) return "hdIsEnabled: force output is off";
  const unsigned int code = fault_code_.load() != HD_SUCCESS ? fault_code_.load() : last_code_.load();
  if (code == HD_SUCCESS) return {};
  return fmt::format("{}{} (0x{:04x})", lost_.load() ? "unplugged: " : "", hd_.get_error_string(code), code);
}

bool HdDevice::may_force() const noexcept { return wanted_.load() && !doomed_.load() && fault_ == 0; }

/// After the frame, which may have taken for ever: whoever wanted the motors off meanwhile has the last word.
void HdDevice::switch_motors(bool wanted, bool were_on) noexcept {
  if (wanted && !were_on) {
    stopper_.motors_on();
    hd_.enable(HD_FORCE_OUTPUT);
    on_since_ = seq_;
  }
  const bool on = wanted && may_force();
  if (!on && (were_on || wanted)) hd_.disable(HD_FORCE_OUTPUT);
  if (on && were_on) look_at_force_output();
  powered_.store(on);
  if (!on) stopper_.motors_off();
}

/// One tick of the vendor's scheduler.
unsigned int HdDevice::frame(void* self) {
  auto& device = *static_cast<HdDevice*>(self);
  const Hd& hd = device.hd_;
  if (device.lost_.load() || device.leave_alone_.load() || device.stopper_.is_busy())
    return HD_CALLBACK_CONTINUE;
  static thread_local const int scheduler_thread = gettid();  // another one after each rest of the scheduler
  device.scheduler_thread_.store(scheduler_thread);
  hd.make_current(device.scheduled_.device);
  hd.begin_frame(device.scheduled_.device);

  // 1. the hand
  Sample sample;
  const std::int64_t now = device.now_ns();
  sample.state.t_ns = now;
  device.measure(sample.state);

  // 2. the force; motors go on and off with none
  const bool wanted = device.may_force();
  const bool were_on = device.powered_.load() && !device.stopper_.is_off();
  const kit::Effort effort = wanted && were_on ? device.effort_due(now) : kit::Effort{};
  if (wanted || were_on || device.stopper_.take_zero_owed()) device.set_effort(effort);
  hd.end_frame(device.scheduled_.device);
  device.switch_motors(wanted, were_on);

  // 3. what the vendor has to say, and what the host is told
  device.heed_errors(sample);
  sample.state.fault = device.fault_;
  sample.state.force_enabled = device.powered_.load() ? 1u : 0u;
  std::copy_n(effort.force, 3, sample.state.applied_force);
  std::copy_n(effort.torque, 3, sample.state.applied_torque);
  sample.state.seq = ++device.seq_;
  device.samples_.write(sample);
  device.stopper_.frame_ends();
  return HD_CALLBACK_CONTINUE;
}

void HdDevice::measure(hdev_state& state) const noexcept {
  std::array<double, 16> m{};  // column after column, the last one the position [mm]
  hd_.get_doubles(HD_CURRENT_TRANSFORM, m.data());
  std::array<double, 3> v{}, w{};
  hd_.get_doubles(HD_CURRENT_VELOCITY, v.data());
  hd_.get_doubles(HD_CURRENT_ANGULAR_VELOCITY, w.data());
  state.valid =
      info_.caps & (HDEV_CAP_POS | HDEV_CAP_VEL | HDEV_CAP_ROT | HDEV_CAP_ANGVEL | HDEV_CAP_TEMPERATURE);
  const bool turns = (info_.caps & HDEV_CAP_ROT) != 0;
  for (std::size_t i = 0; i < 3; ++i) {
    state.pos[i] = m[12 + i] * mm;
    state.vel[i] = v[i] * mm;
    state.angvel[i] = turns ? w[i] : 0.0;
    for (std::size_t j = 0; j < 3; ++j) state.R[3 * i + j] = turns ? m[4 * j + i] : (i == j ? 1.0 : 0.0);
  }
  std::array<double, most_motors> motors{};
  hd_.get_doubles(HD_MOTOR_TEMPERATURE, motors.data());
  state.temperature = *std::max_element(motors.begin(), motors.end());
  int buttons = 0;
  hd_.get_integers(HD_CURRENT_BUTTONS, &buttons);
  state.buttons = static_cast<std::uint32_t>(buttons);
}

/// What the host wrote last, or nothing if that is too long ago.
kit::Effort HdDevice::effort_due(std::int64_t now) noexcept {
  const Order* order = orders_.newest();
  if (order == nullptr || now - order->t_ns > silence_ns) return {};
  return order->effort;
}

void HdDevice::set_effort(const kit::Effort& effort) const noexcept {
  hd_.set_doubles(HD_CURRENT_FORCE, effort.force);
  if ((info_.caps & HDEV_CAP_TORQUE) == 0) return;
  std::array<double, 3> torque{};
  for (std::size_t i = 0; i < 3; ++i) torque[i] = effort.torque[i] / mN_m;
  hd_.set_doubles(HD_CURRENT_TORQUE, torque.data());
}

void HdDevice::heed_errors(Sample& sample) noexcept {
  bool failed = false;
  for (int i = 0; i < 16; ++i) {
    const HDErrorInfo error = hd_.get_error();
    if (error.code == HD_SUCCESS) break;
    last_code_.store(error.code);
    const Meaning meaning = meaning_of(error.code);
    failed = failed || meaning.transfer_failed;
    fault_ |= meaning.fault;
    if (meaning.fault != 0 && fault_code_.load() == HD_SUCCESS) fault_code_.store(error.code);
  }
  failed_in_a_row_ = failed ? failed_in_a_row_ + 1 : 0;
  if (failed) sample.status = HDEV_E_COMM;
  if (failed_in_a_row_ < transfers_to_lost) return;
  hd_.disable(HD_FORCE_OUTPUT);  // should the cable come back, nothing is driven
  powered_.store(false);
  stopper_.motors_off();
  lost_.store(true);
}

/// Whether the device has switched its forces off without an error.
void HdDevice::look_at_force_output() noexcept {
  if (hd_.is_enabled == nullptr || seq_ % frames_between_looks != 0 || seq_ - on_since_ < frames_to_settle)
    return;
  if (hd_.is_enabled(HD_FORCE_OUTPUT) != 0) return;
  dropped_.store(true);
  fault_ |= HDEV_FAULT_FORCE_OFF;
}

/// The host has asked in vain once more.
bool HdDevice::is_dead() noexcept {
  if (++reads_in_vain_ >= reads_to_dead && now_ns() - heard_ns_ > dead_ns) dead_.store(true);
  return dead_.load();
}

hdev_status HdDevice::read(hdev_state& state) noexcept {
  if (lost_.load()) return HDEV_E_LOST;
  const Sample* sample = samples_.newest();
  if (sample == nullptr || sample->state.seq == last_seq_) {
    if (!is_dead()) return HDEV_E_AGAIN;
    if (sample != nullptr) state = sample->state;
    state.fault = HDEV_FAULT_SILENT;
    return HDEV_E_FAULT;
  }
  last_seq_ = sample->state.seq;
  heard_ns_ = now_ns();
  reads_in_vain_ = 0;
  if (sample->status != HDEV_OK) return sample->status;
  state = sample->state;
  state.cal = calibration_.load();
  return state.fault != 0 ? HDEV_E_FAULT : HDEV_OK;
}

hdev_status HdDevice::write(const kit::Effort& effort) noexcept {
  if (lost_.load()) return HDEV_E_LOST;
  orders_.write({effort, now_ns()});
  return HDEV_OK;
}

hdev_status HdDevice::stop() noexcept {
  wanted_.store(false);
  if (!lost_.load()) stopper_.ask();
  return HDEV_OK;
}

bool HdDevice::motors_are_off() const noexcept { return lost_.load() || stopper_.is_off(); }

}  // namespace palpate::haptic::openhaptics
