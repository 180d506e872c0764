#include "haptic_node/drivers/spacenav/spacenav_device.h"

#include <poll.h>
#include <spnav.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdio>

namespace palpate::haptic::spacenav {
namespace {

std::atomic<bool> taken{false};

}  // namespace

SpacenavDevice::SpacenavDevice(const hdev_host& host, const Settings& settings)
    : OpenDevice(host), settings_(settings) {
  if (taken.exchange(true))
    throw kit::Trouble(HDEV_E_BUSY,
                       "another tool of this program has the 3-D mouse; libspnav knows one connection");
  if (spnav_open() < 0) {
    taken.store(false);
    throw kit::Trouble(HDEV_E_NODEV, "spacenavd does not answer; start it again and see what it says");
  }
  last_ns_ = now_ns();
  listener_ = std::thread([this] { listen(); });
}

SpacenavDevice::~SpacenavDevice() {
  leaving_.store(true);
  listener_.join();
  spnav_close();
  taken.store(false);
}

void SpacenavDevice::fill(hdev_info& info) const {
  info.caps = HDEV_CAP_POS | HDEV_CAP_ROT | HDEV_CAP_VEL | HDEV_CAP_ANGVEL;
  std::snprintf(info.vendor, sizeof info.vendor, "spacenavd");
  std::snprintf(info.model, sizeof info.model, "3-D mouse");
  info.dof_in = 6;
  info.n_buttons = 32;
  for (int i = 0; i < 3; ++i) {
    info.ws_min[i] = -settings_.half_workspace;
    info.ws_max[i] = settings_.half_workspace;
  }
  info.nominal_rate_hz = 1000;
}

void SpacenavDevice::power(bool on) {
  if (on) throw kit::Trouble(HDEV_E_UNSUPPORTED, "a 3-D mouse has no motors");
}

std::string SpacenavDevice::last_words() const { return lost_.load() ? "spacenavd has gone" : ""; }

void SpacenavDevice::listen() noexcept {
  Deflection now;
  while (!leaving_.load()) {
    pollfd wait{spnav_fd(), POLLIN, 0};
    if (poll(&wait, 1, 10) <= 0) continue;
    if (!take_events(now)) {
      lost_.store(true);
      return;
    }
    deflections_.write(now);
  }
}

/// @return false if there was something to read, but no event: the daemon has gone
bool SpacenavDevice::take_events(Deflection& now) noexcept {
  char one = 0;
  if (recv(spnav_fd(), &one, 1, MSG_PEEK | MSG_DONTWAIT) == 0) return false;
  spnav_event event{};
  while (spnav_poll_event(&event) != 0) {
    if (event.type == SPNAV_EVENT_MOTION) {
      const auto& m = event.motion;
      const std::array<int, 6> counts{m.x, m.y, m.z, m.rx, m.ry, m.rz};
      for (std::size_t i = 0; i < 6; ++i) now.d[i] = std::clamp(counts[i] / full_deflection, -1.0, 1.0);
    } else if (event.type == SPNAV_EVENT_BUTTON && event.button.bnum >= 0 && event.button.bnum < 32) {
      const std::uint32_t bit = 1u << static_cast<unsigned>(event.button.bnum);
      now.buttons = event.button.press != 0 ? now.buttons | bit : now.buttons & ~bit;
    }
  }
  return true;
}

hdev_status SpacenavDevice::read(hdev_state& state) noexcept {
  if (lost_.load()) return HDEV_E_LOST;
  const Deflection* newest = deflections_.newest();
  const Deflection push = newest == nullptr ? Deflection{} : *newest;
  const std::int64_t now = now_ns();
  const double dt = std::clamp(static_cast<double>(now - last_ns_) * 1e-9, 0.0, longest_step);
  last_ns_ = now;

  const Eigen::Vector3d v = settings_.speed * Eigen::Vector3d(push.d[0], push.d[1], push.d[2]);
  const Eigen::Vector3d w = settings_.turn * Eigen::Vector3d(push.d[3], push.d[4], push.d[5]);
  const Eigen::Vector3d before = x_;
  x_ = (x_ + v * dt).cwiseMax(-settings_.half_workspace).cwiseMin(settings_.half_workspace);
  if (const double angle = w.norm() * dt; angle > 0)
    q_ = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, w.normalized())) * q_).normalized();

  state.valid = HDEV_CAP_POS | HDEV_CAP_ROT | HDEV_CAP_VEL | HDEV_CAP_ANGVEL;
  state.seq = ++seq_;
  state.t_ns = now;
  const Eigen::Matrix3d r = q_.toRotationMatrix();
  for (Eigen::Index i = 0; i < 3; ++i) {
    state.pos[i] = x_[i];
    state.vel[i] = dt > 0 ? (x_[i] - before[i]) / dt : 0.0;
    state.angvel[i] = w[i];
    for (Eigen::Index j = 0; j < 3; ++j) state.R[3 * i + j] = r(i, j);
  }
  state.buttons = push.buttons;
  return HDEV_OK;
}

hdev_status SpacenavDevice::write(const kit::Effort&) noexcept { return HDEV_E_UNSUPPORTED; }

}  // namespace palpate::haptic::spacenav
