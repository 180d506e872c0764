#include "haptic_node/drivers/forcedimension/dhd_device.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "haptic_node/drivers/kit/emergency.h"

namespace palpate::haptic::forcedimension {
namespace {

using Status = std::array<int, status_room>;

/// Opens the first device, or the one with the number that `id` is. @return its number from now on
int open_number(const Dhd& dhd, const std::string& id) {
  if (id.empty()) return dhd.open_first();
  char* end = nullptr;
  const long number = std::strtol(id.c_str(), &end, 10);
  if (*end != '\0' || number < 0 || number > 100)
    throw kit::Trouble(HDEV_E_ARG, fmt::format("id is \"{}\"; the number of a device is wanted, from 0", id));
  return dhd.open_id(static_cast<char>(number));
}

}  // namespace

DhdDevice::DhdDevice(const hdev_host& host, const Dhd& dhd, const std::string& id)
    : OpenDevice(host), dhd_(dhd), model_(models.back()) {
  const int number = open_number(dhd_, id);
  if (number < 0)
    throw kit::Trouble(
        HDEV_E_NODEV,
        fmt::format("device {} does not open: {}; plug it in and switch it on, end other programs that "
                    "use it, and let this user open it (udev rule for USB vendor 1451)",
                    id.empty() ? "0" : id, dhd_.get_last_error()));
  id_ = static_cast<char>(number);
  say_what_it_is();
  // A watchdog in the device itself. A device without one answers with an error, and the host's own limits remain.
  const bool watched = dhd_.enable_expert_mode() >= 0 && dhd_.set_watchdog(watchdog_ticks, id_) >= 0;
  if (watched) {
    info_.caps |= HDEV_CAP_HW_WATCHDOG;
    info_.hw_watchdog_s = watchdog_ticks * watchdog_tick;
  } else {
    log(1, fmt::format("the device takes no watchdog: {}", dhd_.get_last_error()));
  }
  dhd_.enable_force(DHD_OFF, id_);
  dhd_.set_max_force(model_.max_force, id_);
  if (dhd_.set_gravity_compensation(DHD_ON, id_) >= 0) info_.caps |= HDEV_CAP_GRAVITY_COMP;
  stopper_ = kit::without_signals([this] { keep_ready_to_stop(); });
  braker_ = kit::without_signals([this] { keep_ready_to_brake(); });
}

/// Motors off, no force, device released.
DhdDevice::~DhdDevice() {
  leaving_.store(true);
  wake_.ring();
  wake_braker_.ring();
  stopper_.join();
  braker_.join();
  if (!lost_.load()) switch_off();
  dhd_.close(id_);
}

void DhdDevice::say_what_it_is() {
  const int type = dhd_.get_system_type(id_);
  model_ = model_of(type);
  std::snprintf(info_.vendor, sizeof info_.vendor, "Force Dimension");
  const char* name = dhd_.get_system_name(id_);
  std::snprintf(info_.model, sizeof info_.model, "%s", name == nullptr ? "unknown" : name);
  unsigned short serial = 0;
  if (dhd_.get_serial_number(&serial, id_) >= 0)
    std::snprintf(info_.serial, sizeof info_.serial, "%u", serial);
  int major = 0, minor = 0, release = 0, revision = 0;
  dhd_.get_sdk_version(&major, &minor, &release, &revision);
  std::snprintf(info_.sdk_version, sizeof info_.sdk_version, "%d.%d.%d.%d", major, minor, release, revision);
  info_.caps = HDEV_CAP_POS | HDEV_CAP_VEL | HDEV_CAP_FORCE | HDEV_CAP_BRAKE;
  if (model_.wrist) info_.caps |= HDEV_CAP_ROT | HDEV_CAP_ANGVEL;
  if (model_.gripper) info_.caps |= HDEV_CAP_GRIP;
  if (model_.max_torque > 0) info_.caps |= HDEV_CAP_TORQUE;
  info_.dof_in = 3u + (model_.wrist ? 3u : 0u) + (model_.gripper ? 1u : 0u);
  info_.dof_out = model_.max_torque > 0 ? 6 : 3;
  info_.n_buttons = 4;
  const std::array<double, 3> half{model_.half_height, model_.half_width, model_.half_height};
  for (std::size_t i = 0; i < 3; ++i) {
    info_.ws_min[i] = -half[i];
    info_.ws_max[i] = half[i];
  }
  info_.max_force = info_.cont_force = model_.max_force;
  info_.max_torque = info_.cont_torque = model_.max_torque;
  info_.max_stiffness = model_.max_stiffness;
  info_.max_damping = model_.max_damping;
  info_.nominal_rate_hz = 1000;
  info_.min_rate_hz = 1.0 / (watchdog_ticks * watchdog_tick);
}

/// The vendor's devices calibrate themselves, or with a hand that leads them; this waits until they have.
void DhdDevice::calibrate(std::uint32_t timeout_ms) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(timeout_ms);
  bool told = false;
  while (true) {
    Status status{};
    if (dhd_.get_status(status.data(), id_) < 0)
      throw kit::Trouble(HDEV_E_COMM, fmt::format("the device does not answer: {}", dhd_.get_last_error()));
    const bool wrist_ready = status[DHD_STATUS_WRIST_DETECTED] == 0 || status[DHD_STATUS_WRIST_INIT] != 0;
    if (status[DHD_STATUS_RESET] == 0 && wrist_ready) break;
    if (!told) log(1, "not calibrated; lead the handle to its reference position, or use the vendor's tool");
    told = true;
    if (std::chrono::steady_clock::now() >= end)
      throw kit::Trouble(
          HDEV_E_NOTCAL,
          fmt::format("still not calibrated after {} ms; lead the handle to its reference position, or "
                      "use the vendor's tool",
                      timeout_ms));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  calibrated_.store(true);
}

/// Some models have no button for that and stay without forces until asked.
void DhdDevice::power(bool on) {
  if (lost_.load()) throw kit::Trouble(HDEV_E_LOST, last_words());
  if (on && !calibrated_.load())
    throw kit::Trouble(HDEV_E_NOTCAL, "forces stay off until the device is calibrated");
  powered_.store(false);
  if (doomed_.load()) return;
  const auto refuse = [this] {
    throw kit::Trouble(HDEV_E_COMM, fmt::format("forces do not switch: {}", dhd_.get_last_error()));
  };
  if (!on) {
    switch_off();
    if (!off_.load()) refuse();
    return;
  }
  off_.store(false);
  if (dhd_.set_effort(0, 0, 0, 0, 0, 0, id_) < 0 || dhd_.enable_force(DHD_ON, id_) < 0) refuse();
  powered_.store(true);
}

std::string DhdDevice::last_words() const {
  const char* why = why_.load();
  return lost_.load() ? fmt::format("unplugged: {}", why) : std::string(why);
}

bool DhdDevice::measure(hdev_state& state) noexcept {
  double r[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double* p = state.pos;
  // Positive answers are no errors.
  if (dhd_.get_position_and_frame(&p[0], &p[1], &p[2], r, id_) < 0) return false;
  if (dhd_.get_linear_velocity(&state.vel[0], &state.vel[1], &state.vel[2], id_) < 0) return false;
  state.valid = HDEV_CAP_POS | HDEV_CAP_VEL;
  if (model_.wrist) {
    if (dhd_.get_angular_velocity(&state.angvel[0], &state.angvel[1], &state.angvel[2], id_) < 0)
      return false;
    state.valid |= HDEV_CAP_ROT | HDEV_CAP_ANGVEL;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) state.R[3 * i + j] = r[i][j];
  }
  if (model_.gripper) {
    if (dhd_.get_gripper_gap(&state.grip, id_) < 0) return false;
    state.valid |= HDEV_CAP_GRIP;
  }
  state.buttons = dhd_.get_buttons(id_);
  return true;
}

std::uint32_t DhdDevice::because(std::uint32_t fault, const char* why) noexcept {
  why_.store(why);
  return fault;
}

/// Why forces are off although we switched them on.
std::uint32_t DhdDevice::faults(const int* status) noexcept {
  if (status[DHD_STATUS_POWER] == 0) return because(HDEV_FAULT_POWER, "status: no power");
  if (status[DHD_STATUS_ERROR] != 0) return because(HDEV_FAULT_INTERNAL, "status: error");
  if (!powered_.load() || status[DHD_STATUS_FORCE] != 0) {
    offs_in_a_row_ = 0;
    return 0;
  }
  switch (status[DHD_STATUS_FORCE_OFF_CAUSE]) {
    case DHD_FORCEOFF_BUTTON:
      return because(HDEV_FAULT_ESTOP, "forces off by the force button");
    case DHD_FORCEOFF_VELOCITY:
      return because(HDEV_FAULT_OVERSPEED, "forces off by the velocity threshold");
    case DHD_FORCEOFF_WATCHDOG:
      return because(HDEV_FAULT_WATCHDOG, "forces off by the device's watchdog");
    case DHD_FORCEOFF_DEADMAN:
      return because(HDEV_FAULT_DEADMAN, "forces off by the dead man's switch");
    default:  // at first between our switching and the next status
      if (++offs_in_a_row_ < offs_to_fault) return 0;
      return because(HDEV_FAULT_FORCE_OFF, "forces are off, and the device does not say why");
  }
}

hdev_status DhdDevice::failed() noexcept {
  const char* words = dhd_.get_last_error();
  why_.store(words == nullptr ? "" : words);
  if (++failed_in_a_row_ >= transfers_to_lost) lost_.store(true);
  return lost_.load() ? HDEV_E_LOST : HDEV_E_COMM;
}

hdev_status DhdDevice::gone(const char* why) noexcept {
  why_.store(why);
  lost_.store(true);
  return HDEV_E_LOST;
}

hdev_status DhdDevice::read(hdev_state& state) noexcept {
  if (lost_.load()) return HDEV_E_LOST;
  Status status{};
  if (dhd_.get_status(status.data(), id_) < 0) return failed();
  if (status[DHD_STATUS_CONNECTED] == 0) return gone("not connected");
  if (status[DHD_STATUS_FORCE_OFF_CAUSE] == DHD_FORCEOFF_USBDISCN) return gone("USB disconnected");
  state.t_ns = now_ns();
  if (!measure(state)) return failed();
  if (failed_in_a_row_ > 0) why_.store("");
  failed_in_a_row_ = 0;
  state.seq = ++seq_;
  state.force_enabled = powered_.load() && status[DHD_STATUS_FORCE] != 0 ? 1u : 0u;
  state.cal = calibrated_.load() ? HDEV_CAL_OK : HDEV_CAL_NEEDED;
  state.fault = faults(status.data());
  return state.fault != 0 ? HDEV_E_FAULT : HDEV_OK;
}

hdev_status DhdDevice::write(const kit::Effort& effort) noexcept {
  if (lost_.load()) return HDEV_E_LOST;
  if (!powered_.load() || doomed_.load()) return HDEV_OK;
  force_ns_.store(kit::clock_ns());
  const auto& f = effort.force;
  const auto& t = effort.torque;
  const int answer = dhd_.set_effort(f[0], f[1], f[2], t[0], t[1], t[2], id_);
  return answer < 0 ? failed() : HDEV_OK;
}

hdev_status DhdDevice::stop() noexcept {
  powered_.store(false);
  wake_.ring();
  return HDEV_OK;
}

/// Told so, or left alone for longer than its own watchdog allows.
bool DhdDevice::motors_are_off() const noexcept {
  if (off_.load()) return true;
  const bool watched = (info_.caps & HDEV_CAP_HW_WATCHDOG) != 0 && !powered_.load();
  return watched && kit::clock_ns() - force_ns_.load() > static_cast<std::int64_t>(1e9 * info_.hw_watchdog_s);
}

void DhdDevice::keep_ready_to_stop() noexcept {
  while (true) {
    wake_.wait();
    if (leaving_.load()) return;
    if (lost_.load() || powered_.load()) continue;
    wake_braker_.ring();
    switch_off();
  }
}

void DhdDevice::keep_ready_to_brake() noexcept {
  while (true) {
    wake_braker_.wait();
    if (leaving_.load()) return;
    if (kit::comes_true([this] { return off_.load(); }, disable_within_us) || powered_.load()) continue;
    if (dhd_.stop(id_) >= 0) off_.store(true);
  }
}

/// First what switches the motors off: what comes after it may hang.
void DhdDevice::switch_off() noexcept {
  if (dhd_.enable_force(DHD_OFF, id_) >= 0) off_.store(true);
  if (dhd_.stop(id_) >= 0) off_.store(true);
  dhd_.set_effort(0, 0, 0, 0, 0, 0, id_);
}

/// The thread that is kept ready lives, unless libdhd is locked by whoever has crashed: it is waited for, then libdhd is
/// called from here. Whatever hangs, the device hears no more forces, and its own watchdog lets go.
hdev_status DhdDevice::emergency_stop(std::uint32_t within_us) noexcept {
  doomed_.store(true);
  stop();
  if (lost_.load() || kit::comes_true([this] { return off_.load(); }, within_us / 4 * 3)) return HDEV_OK;
  switch_off();
  return off_.load() ? HDEV_OK : HDEV_E_COMM;
}

void rescue_device(const Dhd& dhd, const std::string& id) {
  const int number = open_number(dhd, id);
  if (number < 0) throw kit::Trouble(HDEV_E_NODEV, dhd.get_last_error());
  const char device = static_cast<char>(number);
  const bool off = dhd.enable_force(DHD_OFF, device) >= 0;
  const bool braked = dhd.stop(device) >= 0;
  dhd.set_effort(0, 0, 0, 0, 0, 0, device);
  const std::string words = off || braked ? "" : dhd.get_last_error();
  dhd.close(device);
  if (!words.empty()) throw kit::Trouble(HDEV_E_COMM, words);
}

}  // namespace palpate::haptic::forcedimension
