// The simulated driver with a test that looks over its shoulder and can make trouble: see watched_device.h. It lies in a
// folder of its own under the same name, so that a scene for the simulated driver finds it by PALPATE_DRIVERS.

#include <dlfcn.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <memory>
#include <thread>

#include "haptic_node/device/haptic_device.h"
#include "tests/support/devices/watched_device.h"

using palpate::test::WatchedDevice;
using palpate::test::WatchedFile;

namespace {

const hdev_api* inner_api() {
  static const hdev_api* const api = [] {
    void* library = dlopen(WATCHED_INNER, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) std::abort();
    const auto query = reinterpret_cast<hdev_plugin_query_fn>(dlsym(library, HDEV_ENTRY_SYMBOL));
    return query(HDEV_ABI_MAJOR, HDEV_ABI_MINOR);
  }();
  return api;
}

const char* open_trouble = "";

}  // namespace

struct hdev {
  explicit hdev(const char* file) : watched(file, WatchedFile::Role::driver) {}

  WatchedFile watched;
  const hdev_host* host = nullptr;
  hdev* inner = nullptr;
  bool calibrated = false;
  std::atomic<bool> lost{false};
  double z = 0, felt = 0;
  std::atomic<bool> end{false};
  std::thread trouble;

  /// Another thread of the process, as a vendor's library or DDS would have it.
  void wait_for_trouble() {
    while (!end.load()) {
      const std::uint32_t crash = watched->crash.load();
      if (crash == 1) {
        volatile int* volatile nowhere = nullptr;
        *nowhere = 1;
      }
      if (crash == 2) std::exit(3);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  static void hang(const std::atomic<std::uint32_t>& while_set) {
    while (while_set.load() != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void called() noexcept {
    if (lost.load()) watched->after_lost.fetch_add(1);
  }
};

namespace {

hdev_status open_watched(const hdev_host* host, const char*, const char* const* kv, std::uint32_t n_kv,
                         hdev** out) {
  *out = nullptr;
  const char* file = std::getenv(WatchedDevice::variable);
  open_trouble = "the test has made no file";
  if (file == nullptr) return HDEV_E_ARG;
  try {
    auto device = std::make_unique<hdev>(file);
    device->watched->opening.fetch_add(1);
    hdev::hang(device->watched->hang_open);
    open_trouble = "unplugged";
    if (device->watched->unplugged.load() != 0) return HDEV_E_NODEV;
    device->host = host;
    const hdev_status status = inner_api()->open(host, "", kv, n_kv, &device->inner);
    open_trouble = inner_api()->last_error(nullptr);
    if (status != HDEV_OK) return status;
    device->watched->opened.fetch_add(1);
    if (std::getenv("PALPATE_WATCHED_TROUBLE") != nullptr)
      device->trouble = std::thread([device = device.get()] { device->wait_for_trouble(); });
    *out = device.release();
    return HDEV_OK;
  } catch (const std::exception&) {
    return HDEV_E_ARG;
  }
}

hdev_status enumerate_watched(const hdev_host*, char (*)[64], std::uint32_t, std::uint32_t* n) {
  *n = 0;
  return HDEV_OK;
}

hdev_status info_watched(hdev* device, hdev_info* info) {
  device->called();
  const hdev_status status = inner_api()->get_info(device->inner, info);
  info->caps |= HDEV_CAP_DEADMAN | HDEV_CAP_TEMPERATURE;
  return status;
}

hdev_status calibrate_watched(hdev* device, std::uint32_t) {
  device->called();
  device->watched->calibrated.fetch_add(1);
  device->calibrated = true;
  return HDEV_OK;
}

void cut_power(hdev* device) { device->watched->powered.store(0); }

hdev_status power_watched(hdev* device, std::uint32_t on) {
  device->called();
  if (on == 0) cut_power(device);
  (on != 0 ? device->watched->enabled : device->watched->disabled).fetch_add(1);
  hdev::hang(device->watched->hang_enable);
  device->watched->powered.store(on);
  return inner_api()->enable_force(device->inner, on);
}

void close_watched(hdev* device) {
  if (device == nullptr) return;
  cut_power(device);
  hdev::hang(device->watched->hang_close);
  device->watched->closed.fetch_add(1);
  device->end.store(true);
  if (device->trouble.joinable()) device->trouble.join();
  inner_api()->close(device->inner);
  delete device;
}

const char* error_of(hdev* device) {
  return device == nullptr ? open_trouble : device->watched->words.data();
}

hdev_status attach_watched(hdev* device) {
  device->called();
  device->watched->loop_thread.store(gettid());
  return HDEV_OK;
}

hdev_status read_watched(hdev* device, hdev_state* state, std::uint32_t timeout_us) {
  device->called();
  device->watched->reads.fetch_add(1);
  if (const std::uint32_t ms = device->watched->block_read_ms.load(); ms > 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
  hdev::hang(device->watched->hang_read);
  if (device->watched->unplugged.load() != 0) {
    device->lost.store(true);
    return HDEV_E_LOST;
  }
  const hdev_status status = inner_api()->read(device->inner, state, timeout_us);
  device->z = state->pos[2];
  device->felt = state->applied_force[2];
  state->deadman = device->watched->let_go.load() == 0 ? 1u : 0u;
  state->fault = device->watched->estop.load() != 0 ? std::uint32_t{HDEV_FAULT_ESTOP} : 0u;
  state->cal = device->calibrated ? HDEV_CAL_OK : HDEV_CAL_NEEDED;
  if (device->watched->temperature.load() >= 0) {
    state->valid |= HDEV_CAP_TEMPERATURE;
    state->temperature = device->watched->temperature.load();
  }
  if (device->watched->dead.load() != 0) state->fault |= HDEV_FAULT_SILENT;
  if (device->watched->dropped.load() != 0) state->force_enabled = 0;
  if (device->watched->nonsense.load() != 0) state->pos[1] = std::nan("");
  return status;
}

hdev_status write_watched(hdev* device, const hdev_command* command) {
  device->called();
  WatchedDevice& watched = *device->watched;
  const double* f = command->force;
  const double* m = command->torque;
  const double norm = std::hypot(f[0], f[1], f[2]), torque = std::hypot(m[0], m[1], m[2]);
  const std::uint64_t n = watched.writes.load();
  const std::uint32_t powered = watched.powered.load();
  watched.log[n % WatchedDevice::kept] = {
      device->host->now_ns(device->host->user), device->z, device->felt, f[2], norm, torque, powered};
  watched.writes.store(n + 1);
  return inner_api()->write(device->inner, command);
}

hdev_status stop_watched(hdev* device) {
  device->called();
  device->watched->stops.fetch_add(1);
  cut_power(device);
  return inner_api()->stop(device->inner);
}

/// As a driver of minor version 0 hands it out: what came later lies behind its end.
const hdev_api api = {offsetof(hdev_api, emergency_stop),
                      HDEV_ABI_MAJOR,
                      0,
                      0,
                      "watched",
                      "1.0",
                      enumerate_watched,
                      open_watched,
                      info_watched,
                      calibrate_watched,
                      power_watched,
                      close_watched,
                      error_of,
                      attach_watched,
                      read_watched,
                      write_watched,
                      stop_watched,
                      nullptr,
                      nullptr,
                      nullptr};

}  // namespace

extern "C" const hdev_api* hdev_plugin_query(std::uint32_t host_major, std::uint32_t) {
  return host_major == HDEV_ABI_MAJOR ? &api : nullptr;
}
