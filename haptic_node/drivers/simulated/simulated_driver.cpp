// The driver "simulated": a device with a hand on it, both computed. It runs in the host's clock, real or simulated.
// See docs/device.md for the contract and simulated_options.h for what can be set.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include "haptic_node/device/haptic_device.h"
#include "haptic_node/drivers/simulated/simulated_hand.h"
#include "haptic_node/drivers/simulated/simulated_options.h"
#include "haptic_node/drivers/simulated/simulated_turn.h"

using palpate::haptic::simulated::Array3;
using palpate::haptic::simulated::parse_options;
using palpate::haptic::simulated::SimulatedHand;
using palpate::haptic::simulated::SimulatedOptions;
using palpate::haptic::simulated::SimulatedTurn;

namespace {

constexpr std::int64_t watchdog_ns =
    30'000'000;  // silence after which the motors let go until the next command

/// Normal noise from a counter-free generator (xorshift64*, sum of twelve uniforms), the same everywhere.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) noexcept : state_(seed * 0x9e3779b97f4a7c15ULL | 1u) {}
  double next() noexcept {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      state_ ^= state_ >> 12;
      state_ ^= state_ << 25;
      state_ ^= state_ >> 27;
      sum += static_cast<double>((state_ * 0x2545f4914f6cdd1dULL) >> 11) * 0x1p-53;
    }
    return sum;
  }

 private:
  std::uint64_t state_;
};

std::string& open_trouble() {
  static std::string text;
  return text;
}

}  // namespace

struct hdev {
  hdev(const hdev_host* the_host, const SimulatedOptions& the_options)
      : host(the_host),
        options(the_options),
        hand(options, now()),
        turn(options, now()),
        noise(options.seed) {}

  const hdev_host* host;
  SimulatedOptions options;
  SimulatedHand hand;
  SimulatedTurn turn;
  Noise noise;
  Array3 force{}, torque{};  // commanded [N], [N m]
  std::int64_t last_write_ns = 0;
  std::uint64_t seq = 0;
  std::atomic<bool> powered{false};  // enable_force() and stop() may come from other threads
  std::atomic<bool> path_asked{false};

  std::int64_t now() const noexcept { return host->now_ns(host->user); }
};

namespace {

void advance(hdev& device, std::int64_t now) noexcept {
  if (!device.powered.load()) device.force = device.torque = {};
  device.hand.advance_to(now, device.force, device.last_write_ns + watchdog_ns);
  const bool path_asked = device.path_asked.load();
  if (path_asked) device.hand.start_path();
  if (!device.options.turns()) return;
  device.turn.advance_to(now, device.torque, device.last_write_ns + watchdog_ns);
  if (path_asked) device.turn.start_path();
}

/// Shortened to `limit`, direction kept. @return false if it is not finite
bool limit_norm(Array3& v, double limit) noexcept {
  const double norm = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!std::isfinite(norm)) return false;
  if (norm > limit)
    for (double& component : v) component *= limit / norm;
  return true;
}

hdev_status sim_enumerate(const hdev_host*, char (*ids)[64], std::uint32_t cap, std::uint32_t* n) {
  if (n == nullptr) return HDEV_E_ARG;
  if (cap > 0) std::snprintf(ids[0], sizeof ids[0], "simulated");
  *n = 1;
  return HDEV_OK;
}

hdev_status sim_open(const hdev_host* host, const char* id, const char* const* kv, std::uint32_t n_kv,
                     hdev** out) {
  *out = nullptr;
  if (id != nullptr && *id != '\0' && std::strcmp(id, "simulated") != 0) {
    open_trouble() = std::string("no device \"") + id + "\"; there is only \"simulated\"";
    return HDEV_E_NODEV;
  }
  try {
    SimulatedOptions options;
    open_trouble() = parse_options(kv, n_kv, options);
    if (!open_trouble().empty()) return HDEV_E_ARG;
    *out = new hdev(host, options);
    return HDEV_OK;
  } catch (const std::bad_alloc&) {
    return HDEV_E_BUSY;
  }
}

hdev_status sim_get_info(hdev* device, hdev_info* info) {
  const SimulatedOptions& options = device->options;
  hdev_info full{};
  full.size = info->size;
  full.caps = HDEV_CAP_POS | HDEV_CAP_VEL | HDEV_CAP_FORCE | HDEV_CAP_HW_WATCHDOG | HDEV_CAP_SIMULATED;
  std::snprintf(full.vendor, sizeof full.vendor, "palpate");
  const auto& model = options.device;
  const bool plain = options.model == "plain";
  std::snprintf(full.model, sizeof full.model, "simulated hand%s%s", plain ? "" : " on a device like ",
                plain ? "" : options.model.c_str());
  full.dof_in = full.dof_out = 3;
  full.n_buttons = options.pressed.empty() ? 0 : 1;
  for (int i = 0; i < 3; ++i) {
    full.ws_min[i] = -options.half_workspace;
    full.ws_max[i] = options.half_workspace;
  }
  if (options.turns()) full.caps |= HDEV_CAP_ROT | HDEV_CAP_ANGVEL, full.dof_in = 6;
  if (options.turn.max_torque > 0) full.caps |= HDEV_CAP_TORQUE, full.dof_out = 6;
  full.max_torque = full.cont_torque = options.turn.max_torque;
  full.max_force = model.max_force;
  full.cont_force = model.cont_force;
  full.max_stiffness = model.max_stiffness;
  full.friction = model.friction;
  full.max_damping = 5.0;
  full.pos_resolution = std::max(options.noise, model.resolution);
  full.apparent_mass = model.mass;
  full.nominal_rate_hz = 1000;
  full.hw_watchdog_s = static_cast<double>(watchdog_ns) * 1e-9;
  std::memcpy(info, &full, std::min<std::size_t>(info->size, sizeof full));
  return HDEV_OK;
}

hdev_status sim_calibrate(hdev*, std::uint32_t) { return HDEV_OK; }

hdev_status sim_enable_force(hdev* device, std::uint32_t on) {
  device->powered.store(on != 0);
  if (on != 0) device->path_asked.store(true);
  return HDEV_OK;
}

void sim_close(hdev* device) { delete device; }

const char* sim_last_error(hdev* device) { return device == nullptr ? open_trouble().c_str() : ""; }

hdev_status sim_rt_attach(hdev*) { return HDEV_OK; }

hdev_status sim_read(hdev* device, hdev_state* state, std::uint32_t) {
  const std::int64_t now = device->now();
  advance(*device, now);
  hdev_state full{};
  full.size = state->size;
  full.valid = HDEV_CAP_POS | HDEV_CAP_VEL;
  full.seq = ++device->seq;
  full.t_ns = now;
  full.R[0] = full.R[4] = full.R[8] = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    full.pos[i] = device->hand.position()[i];
    if (device->options.noise > 0) full.pos[i] += device->options.noise * device->noise.next();
    if (const double q = device->options.device.resolution; q > 0)
      full.pos[i] = q * std::round(full.pos[i] / q);
    full.vel[i] = device->hand.velocity()[i];
    full.applied_force[i] = now < device->last_write_ns + watchdog_ns ? device->force[i] : 0.0;
    full.applied_torque[i] = now < device->last_write_ns + watchdog_ns ? device->torque[i] : 0.0;
    full.angvel[i] = device->turn.velocity()(static_cast<Eigen::Index>(i));
  }
  if (device->options.turns()) {
    full.valid |= HDEV_CAP_ROT | HDEV_CAP_ANGVEL;
    const Eigen::Matrix3d R = device->turn.attitude().toRotationMatrix();
    for (Eigen::Index i = 0; i < 9; ++i) full.R[i] = R(i / 3, i % 3);
  }
  full.buttons = device->hand.presses() ? 1u : 0u;
  full.temperature = -1.0;
  full.force_enabled = device->powered.load() ? 1u : 0u;
  full.cal = HDEV_CAL_OK;
  std::memcpy(state, &full, std::min<std::size_t>(state->size, sizeof full));
  return HDEV_OK;
}

hdev_status sim_write(hdev* device, const hdev_command* command) {
  Array3 force{}, torque{};
  std::copy_n(command->force, 3, force.begin());
  std::copy_n(command->torque, 3, torque.begin());
  if (!limit_norm(force, device->options.device.max_force) ||
      !limit_norm(torque, device->options.turn.max_torque))
    return HDEV_E_ARG;
  const std::int64_t now = device->now();
  advance(*device, now);
  const bool powered = device->powered.load();
  device->force = powered ? force : Array3{};
  device->torque = powered ? torque : Array3{};
  device->last_write_ns = now;
  return HDEV_OK;
}

hdev_status sim_stop(hdev* device) {
  device->powered.store(false);
  return HDEV_OK;
}

/// What moves this hand is computed in this process and ends with it.
hdev_status sim_emergency_stop(hdev* device, std::uint32_t) { return sim_stop(device); }

const hdev_api api = {sizeof(hdev_api), HDEV_ABI_MAJOR,
                      HDEV_ABI_MINOR,   0,
                      "simulated",      "1.0",
                      sim_enumerate,    sim_open,
                      sim_get_info,     sim_calibrate,
                      sim_enable_force, sim_close,
                      sim_last_error,   sim_rt_attach,
                      sim_read,         sim_write,
                      sim_stop,         sim_emergency_stop,
                      nullptr,          nullptr};

}  // namespace

extern "C" const hdev_api* hdev_plugin_query(std::uint32_t host_major, std::uint32_t) {
  return host_major == HDEV_ABI_MAJOR ? &api : nullptr;
}
