#include "haptic_node/drivers/mouse/mouse_device.h"

#include <algorithm>
#include <cstdio>

#include "common/message/vec3.h"

namespace palpate::haptic::mouse {
namespace {

constexpr std::chrono::milliseconds look_up_time{20};

}  // namespace

MouseDevice::MouseDevice(const hdev_host& host, const Settings& settings)
    : OpenDevice(host),
      settings_(settings),
      participant_(settings.domain),
      speaker_(participant_, "render", std::chrono::nanoseconds(silence_ns)),
      pointers_(participant_, &speaker_),
      follower_(settings.speed / settings.scale) {
  listener_ = std::thread([this] { listen(); });
}

MouseDevice::~MouseDevice() {
  leaving_.store(true);
  listener_.join();
}

void MouseDevice::fill(hdev_info& info) const {
  info.caps = HDEV_CAP_POS | HDEV_CAP_ROT | HDEV_CAP_FORCE | HDEV_CAP_DEADMAN | HDEV_CAP_SIMULATED;
  std::snprintf(info.vendor, sizeof info.vendor, "palpate");
  std::snprintf(info.model, sizeof info.model, "mouse in the window");
  info.dof_in = 6;
  info.dof_out = 3;
  info.n_buttons = 32;
  info.max_force = info.cont_force = settings_.max_force;
  info.nominal_rate_hz = 1000;
}

std::string MouseDevice::last_words() const { return window_.load() ? "" : "no window points"; }

void MouseDevice::listen() noexcept {
  Heard heard;
  while (!leaving_.load()) {
    const bool any = pointers_.wait(look_up_time);
    window_.store(pointers_.matched() > 0);
    if (!any) continue;
    while (pointers_.take(heard.pointer)) {
      if (heard.pointer.tool != settings_.tool) continue;
      heard.t_ns = now_ns();
      heard_.write(heard);
    }
  }
}

hdev_status MouseDevice::read(hdev_state& state) noexcept {
  const std::int64_t now = now_ns();
  const double dt = std::clamp(static_cast<double>(now - last_ns_) * 1e-9, 0.0, longest_step);
  last_ns_ = now;
  const Heard* heard = heard_.newest();
  if (heard == nullptr || !window_.load() || now - heard->t_ns > silence_ns) return HDEV_E_AGAIN;
  const Pointer& pointer = heard->pointer;
  const Eigen::Matrix3d to_device = settings_.rotation.transpose();
  const Eigen::Vector3d p = to_device * (vec(pointer.p_W) - settings_.offset) / settings_.scale;
  const Array4& q_W = pointer.q_W;
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(to_device) * Eigen::Quaterniond(q_W[0], q_W[1], q_W[2], q_W[3]);
  if (!began_) follower_.begin(p, q);
  began_ = true;
  follower_.step(p, q, dt);

  state.valid = HDEV_CAP_POS | HDEV_CAP_ROT | HDEV_CAP_DEADMAN;
  state.seq = ++seq_;
  state.t_ns = now;
  const Eigen::Matrix3d r = follower_.q().toRotationMatrix();
  for (Eigen::Index i = 0; i < 3; ++i) {
    state.pos[i] = follower_.x()[i];
    state.applied_force[i] = powered_.load() ? force_[i] : 0.0;
    for (Eigen::Index j = 0; j < 3; ++j) state.R[3 * i + j] = r(i, j);
  }
  state.buttons = pointer.buttons;
  state.deadman = pointer.held;
  state.force_enabled = powered_.load() ? 1u : 0u;
  return HDEV_OK;
}

hdev_status MouseDevice::write(const kit::Effort& effort) noexcept {
  std::copy(std::begin(effort.force), std::end(effort.force), std::begin(force_));
  return HDEV_OK;
}

hdev_status MouseDevice::stop() noexcept {
  powered_.store(false);
  return HDEV_OK;
}

}  // namespace palpate::haptic::mouse
