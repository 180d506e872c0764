#include "haptic_node/drivers/openigtlink/igtl_device.h"

#include <fmt/format.h>

#include <cstdio>

namespace palpate::haptic::openigtlink {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds look_up_time{20};

kit::Trouble no_server(const Settings& settings, const char* why) {
  return {HDEV_E_NODEV,
          fmt::format("no OpenIGTLink server at {}:{} ({}); start it, or name it with server_host and "
                      "server_port",
                      settings.host, settings.port, why)};
}

}  // namespace

IgtlDevice::IgtlDevice(const hdev_host& host, const Settings& settings, const std::string& id) try
    : OpenDevice(host), settings_(settings), id_(id), stream_(settings_.host, settings_.port) {
  const auto end = Clock::now() + first_pose_time;
  while (!take_poses()) {
    if (Clock::now() >= end)
      throw kit::Trouble(
          HDEV_E_NODEV,
          fmt::format("the server at {}:{} sends no TRANSFORM or POSITION{}; make it track the tool",
                      settings_.host, settings_.port, id.empty() ? "" : " named \"" + id + "\""));
  }
  listener_ = std::thread([this] { listen(); });
} catch (const kit::ConnectionLost& lost) {
  throw no_server(settings, lost.what());
}

IgtlDevice::~IgtlDevice() {
  leaving_.store(true);
  listener_.join();
}

void IgtlDevice::fill(hdev_info& info) const {
  info.caps = HDEV_CAP_POS | HDEV_CAP_ROT;
  std::snprintf(info.vendor, sizeof info.vendor, "OpenIGTLink");
  std::snprintf(info.model, sizeof info.model, "%s", id_.c_str());
  info.dof_in = 6;
  for (int i = 0; i < 3; ++i) {
    info.ws_min[i] = -settings_.half_workspace;
    info.ws_max[i] = settings_.half_workspace;
  }
}

void IgtlDevice::power(bool on) {
  if (on) throw kit::Trouble(HDEV_E_UNSUPPORTED, "a tracked tool has no motors");
}

std::string IgtlDevice::last_words() const { return lost_.load() ? lost_words_ : std::string(); }

void IgtlDevice::listen() noexcept {
  try {
    while (!leaving_.load()) take_poses();
  } catch (const std::exception& error) {
    lost_words_ = std::string("the tracker server has gone: ") + error.what();
    lost_.store(true);
  }
}

/// Waits a little for bytes. @return whether a pose of the tool was in them
/// @throws ConnectionLost
bool IgtlDevice::take_poses() {
  std::string bytes;
  if (!stream_.read_more(bytes, Clock::now() + look_up_time)) return false;
  reader_.take(bytes);
  bool found = false;
  while (const auto pose = reader_.next()) {
    if (id_.empty()) id_ = pose->name;
    if (pose->name != id_) continue;
    publish(*pose);
    found = true;
  }
  return found;
}

void IgtlDevice::publish(const TrackedPose& pose) noexcept {
  hdev_state state{};
  state.valid = HDEV_CAP_POS | HDEV_CAP_ROT;
  state.seq = ++seq_;
  state.t_ns = now_ns();  // of its arrival: the server's clock is another one
  state.temperature = -1;
  state.cal = HDEV_CAL_OK;
  for (Eigen::Index i = 0; i < 3; ++i) {
    state.pos[i] = pose.p[i];
    for (Eigen::Index j = 0; j < 3; ++j) state.R[3 * i + j] = pose.r(i, j);
  }
  samples_.write(state);
}

hdev_status IgtlDevice::read(hdev_state& state) noexcept {
  if (lost_.load()) return HDEV_E_LOST;
  const hdev_state* sample = samples_.newest();
  if (sample == nullptr || sample->seq == last_seq_) return HDEV_E_AGAIN;
  last_seq_ = sample->seq;
  state = *sample;
  return HDEV_OK;
}

}  // namespace palpate::haptic::openigtlink
