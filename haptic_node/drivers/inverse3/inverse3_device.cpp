#include "haptic_node/drivers/inverse3/inverse3_device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "haptic_node/drivers/kit/emergency.h"

namespace palpate::haptic::inverse3 {
namespace {

constexpr std::chrono::milliseconds opening_time{2000};

/// What the service says by itself to a newcomer. @throws kit::Trouble
std::string inventory_of(WebSocket& socket, const Settings& settings) {
  std::string inventory;
  if (socket.receive_text(inventory, opening_time)) return inventory;
  throw kit::Trouble(HDEV_E_NODEV, fmt::format("ws://{}:{} says nothing; is it the Haply Inverse service?",
                                               settings.host, settings.port));
}

kit::Trouble no_service(const Settings& settings, const char* why) {
  return {HDEV_E_NODEV,
          fmt::format("no Haply Inverse service at ws://{}:{} ({}); start it, or name it with service_host "
                      "and service_port",
                      settings.host, settings.port, why)};
}

}  // namespace

std::vector<std::string> list_devices(const Settings& settings) {
  try {
    WebSocket socket(settings.host, settings.port, opening_time);
    return devices_in(inventory_of(socket, settings));
  } catch (const ConnectionLost& lost) {
    throw no_service(settings, lost.what());
  }
}

Inverse3Device::Inverse3Device(const hdev_host& host, const Settings& settings, const std::string& id) try
    : OpenDevice(host), settings_(settings), id_(id), socket_(settings_.host, settings_.port, opening_time) {
  const std::string inventory = inventory_of(socket_, settings_);
  const auto ids = devices_in(inventory);
  if (ids.empty()) throw kit::Trouble(HDEV_E_NODEV, "the Haply Inverse service has no Inverse3; plug one in");
  if (id_.empty()) id_ = ids.front();
  if (std::find(ids.begin(), ids.end(), id_) == ids.end())
    throw kit::Trouble(HDEV_E_NODEV,
                       fmt::format("no Inverse3 \"{}\"; the service has {}", id_, fmt::join(ids, ", ")));
  take_update(inventory, id_, known_);
  if (known_.said(HaplyFlag::power_supply) == Said::no)
    log(1, "the Inverse3 has no power supply: no force will be felt");
  if (!exchange(true))
    throw kit::Trouble(HDEV_E_COMM, "the Haply Inverse service does not answer with a state");
  has_grip_ = known_.has_grip;
  no_force_ = WebSocket::frame_of(force_message(settings_.dialect, id_, {}, false));
  thread_ = std::thread([this] { converse(); });
} catch (const ConnectionLost& lost) {
  throw no_service(settings, lost.what());
}

/// The conversation ends with no force.
Inverse3Device::~Inverse3Device() {
  leaving_.store(true);
  thread_.join();
}

void Inverse3Device::fill(hdev_info& info) const {
  info.caps = HDEV_CAP_POS | HDEV_CAP_VEL | HDEV_CAP_FORCE | HDEV_CAP_SHARED;
  if (has_grip_) info.caps |= HDEV_CAP_ROT;
  std::snprintf(info.vendor, sizeof info.vendor, "Haply");
  std::snprintf(info.model, sizeof info.model, "Inverse3");
  std::snprintf(info.serial, sizeof info.serial, "%s", id_.c_str());
  info.dof_in = has_grip_ ? 6 : 3;
  info.dof_out = 3;
  info.n_buttons = 3;
  info.max_force = info.cont_force = settings_.max_force;
  info.max_stiffness = settings_.max_stiffness;
  info.nominal_rate_hz = settings_.rate_Hz;
  info.io_latency_s = 2.0 / settings_.rate_Hz;
}

void Inverse3Device::power(bool on) {
  if (lost_.load()) throw kit::Trouble(HDEV_E_LOST, last_words());
  wanted_.store(on);
}

std::string Inverse3Device::last_words() const {
  return lost_.load() ? lost_words_ : std::string(fault_words_.load());
}

void Inverse3Device::fault(std::uint32_t bit, const char* why) noexcept {
  if (fault_ == 0) fault_words_.store(why);
  fault_ |= bit;
}

/// What the service says of the device itself. Versions differ in what they tell: only what was once said to be so can be no
/// longer so. @param force  that was sent with this message [N]
void Inverse3Device::look_for_faults(const HaplyState& before, const std::array<double, 3>& force) noexcept {
  const auto gone = [&](HaplyFlag flag) {
    return before.said(flag) == Said::yes && known_.said(flag) == Said::no;
  };
  if (gone(HaplyFlag::power_supply)) fault(HDEV_FAULT_POWER, "status: power_supply is false");
  if (gone(HaplyFlag::calibrated)) fault(HDEV_FAULT_FORCE_OFF, "status: calibrated is false");
  if (gone(HaplyFlag::ready)) fault(HDEV_FAULT_FORCE_OFF, "status: ready is false");

  const double sent = std::hypot(force[0], force[1], force[2]);
  const bool nothing = known_.tells_applied && known_.applied == std::array<double, 3>{};
  has_applied_ = has_applied_ || (known_.tells_applied && !nothing);
  nothings_in_a_row_ = has_applied_ && nothing && sent >= certain_force ? nothings_in_a_row_ + 1 : 0;
  if (nothings_in_a_row_ >= nothings_to_fault)
    fault(HDEV_FAULT_FORCE_OFF, "current_cursor_force is none although forces are sent");
}

/// The thread of the conversation: at fixed times, one message and its answer.
void Inverse3Device::converse() noexcept {
  const auto period = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / settings_.rate_Hz));
  auto due = std::chrono::steady_clock::now();
  try {
    while (!leaving_.load()) {
      bad_in_a_row_ = exchange(false) ? 0 : bad_in_a_row_ + 1;
      if (bad_in_a_row_ >= bad_answers_to_lost)
        throw ConnectionLost(fmt::format("the service speaks of no Inverse3 \"{}\" any more", id_));
      due =
          std::max(due + period, std::chrono::steady_clock::now() - period);  // late ones are not made up for
      std::this_thread::sleep_until(due);
    }
    wanted_.store(false);
    exchange(false);
  } catch (const std::exception& error) {
    lost_words_ = error.what();
    lost_.store(true);
  }
}

/// One message, one answer. @return false for an answer that says nothing of the device
/// @throws ConnectionLost
bool Inverse3Device::exchange(bool first) {
  const bool wanted = wanted_.load() && fault_ == 0;
  forcing_.store(forcing_.load() || wanted);
  const bool powered = wanted && !doomed_.load();
  const std::array<double, 3> force = powered ? force_due() : std::array<double, 3>{};
  // After the last force one message with none, then questions only.
  const bool with_force = forcing_.load();
  socket_.send_text(with_force ? force_message(settings_.dialect, id_, force, first)
                               : probe_message(settings_.dialect, id_, first));
  forcing_.store(powered);
  std::string answer;
  if (!socket_.receive_text(answer, answer_time))
    throw ConnectionLost("the Haply Inverse service has fallen silent");
  const HaplyState before = known_;
  const bool good = take_update(answer, id_, known_);
  if (good) look_for_faults(before, force);
  publish(good ? HDEV_OK : HDEV_E_COMM, force, powered);
  return good;
}

/// What the host wrote last, or nothing if that is too long ago.
std::array<double, 3> Inverse3Device::force_due() noexcept {
  const Order* order = orders_.newest();
  if (order == nullptr || now_ns() - order->t_ns > silence_ns) return {};
  return order->force;
}

void Inverse3Device::publish(hdev_status status, const std::array<double, 3>& force, bool powered) noexcept {
  Sample sample;
  hdev_state& state = sample.state;
  sample.status = status;
  state.valid = HDEV_CAP_POS | HDEV_CAP_VEL;
  state.seq = ++seq_;
  state.t_ns = now_ns();
  state.temperature = -1;
  state.cal = HDEV_CAL_OK;
  state.buttons = known_.buttons;
  state.force_enabled = powered ? 1u : 0u;
  state.fault = fault_;
  Eigen::Quaterniond q(known_.grip[0], known_.grip[1], known_.grip[2], known_.grip[3]);
  const bool turned = known_.has_grip && std::abs(q.norm() - 1.0) < 1e-2;
  if (turned) state.valid |= HDEV_CAP_ROT;
  const Eigen::Matrix3d r =
      turned ? q.normalized().toRotationMatrix() : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  for (std::size_t i = 0; i < 3; ++i) {
    state.pos[i] = known_.position[i];
    state.vel[i] = known_.velocity[i];
    state.applied_force[i] = known_.tells_applied ? known_.applied[i] : force[i];
    for (std::size_t j = 0; j < 3; ++j)
      state.R[3 * i + j] = r(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  samples_.write(sample);
}

hdev_status Inverse3Device::read(hdev_state& state) noexcept {
  if (lost_.load()) return HDEV_E_LOST;
  const Sample* sample = samples_.newest();
  if (sample == nullptr || sample->state.seq == last_seq_) return HDEV_E_AGAIN;
  last_seq_ = sample->state.seq;
  if (sample->status != HDEV_OK) return sample->status;
  state = sample->state;
  return state.fault != 0 ? HDEV_E_FAULT : HDEV_OK;
}

hdev_status Inverse3Device::write(const kit::Effort& effort) noexcept {
  if (lost_.load()) return HDEV_E_LOST;
  orders_.write({{effort.force[0], effort.force[1], effort.force[2]}, now_ns()});
  return HDEV_OK;
}

hdev_status Inverse3Device::stop() noexcept {
  wanted_.store(false);
  return HDEV_OK;
}

/// The conversation ends the force with its next message, unless it waits for an answer that does not come, or has crashed.
/// Then the message that was made ready goes to the socket from here.
hdev_status Inverse3Device::emergency_stop(std::uint32_t within_us) noexcept {
  doomed_.store(true);
  if (kit::comes_true([this] { return !forcing_.load(); }, within_us / 2)) return HDEV_OK;
  return socket_.send_now(no_force_) ? HDEV_OK : HDEV_E_COMM;
}

void rescue_device(const Settings& settings, const std::string& id) {
  try {
    WebSocket socket(settings.host, settings.port, opening_time);
    const auto ids = devices_in(inventory_of(socket, settings));
    if (id.empty() && ids.empty()) throw kit::Trouble(HDEV_E_NODEV, "the service has no Inverse3 any more");
    socket.send_text(force_message(settings.dialect, id.empty() ? ids.front() : id, {}, true));
    std::string answer;
    if (!socket.receive_text(answer, Inverse3Device::answer_time))
      throw kit::Trouble(HDEV_E_COMM, "the service does not answer");
  } catch (const ConnectionLost& lost) {
    throw no_service(settings, lost.what());
  }
}

}  // namespace palpate::haptic::inverse3
