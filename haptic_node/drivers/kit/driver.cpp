#include "haptic_node/drivers/kit/driver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>

namespace kit = palpate::haptic::kit;

struct hdev {
  std::unique_ptr<kit::OpenDevice> device;
  hdev_info info{};
  std::string trouble;
  std::string words;  // last handed out by last_error()
};

namespace {

std::string& open_trouble() {
  static std::string text;
  return text;
}

/// Runs `action` and turns what it throws into an answer and words.
template <class Action>
hdev_status answer(std::string& words, Action&& action) noexcept {
  try {
    action();
    words.clear();
    return HDEV_OK;
  } catch (const kit::Trouble& trouble) {
    words = trouble.what();
    return trouble.status;
  } catch (const std::exception& error) {
    words = error.what();
    return HDEV_E_FAULT;
  }
}

/// Writes no more than the owner of `target` knows of.
template <class Struct>
void hand_out(Struct* target, Struct full) noexcept {
  full.size = target->size;
  std::memcpy(target, &full, std::min<std::size_t>(target->size, sizeof full));
}

/// The same direction, no longer than `limit`. @return false if it is not finite
bool limit_norm(double (&v)[3], double limit) noexcept {
  const double norm = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!std::isfinite(norm)) return false;
  if (norm <= limit) return true;
  for (double& component : v) component *= limit / norm;
  return true;
}

hdev_status kit_enumerate(const hdev_host*, char (*ids)[64], std::uint32_t cap, std::uint32_t* n) {
  if (n == nullptr) return HDEV_E_ARG;
  *n = 0;
  return answer(open_trouble(), [&] {
    const auto found = kit::this_driver().list();
    *n = static_cast<std::uint32_t>(found.size());
    for (std::uint32_t i = 0; i < std::min(cap, *n); ++i)
      std::snprintf(ids[i], sizeof ids[i], "%s", found[i].c_str());
  });
}

hdev_status kit_open(const hdev_host* host, const char* id, const char* const* kv, std::uint32_t n_kv,
                     hdev** out) {
  if (host == nullptr || out == nullptr) return HDEV_E_ARG;
  *out = nullptr;
  return answer(open_trouble(), [&] {
    kit::Options options(kv, n_kv);
    auto opened = std::make_unique<hdev>();
    opened->device = kit::this_driver().open(*host, id == nullptr ? "" : id, options);
    opened->device->fill(opened->info);
    *out = opened.release();
  });
}

hdev_status kit_get_info(hdev* device, hdev_info* info) {
  hand_out(info, device->info);
  return HDEV_OK;
}

hdev_status kit_calibrate(hdev* device, std::uint32_t timeout_ms) {
  return answer(device->trouble, [&] { device->device->calibrate(timeout_ms); });
}

hdev_status kit_enable_force(hdev* device, std::uint32_t on) {
  return answer(device->trouble, [&] { device->device->power(on != 0); });
}

void kit_close(hdev* device) { delete device; }

const char* kit_last_error(hdev* device) {
  if (device == nullptr) return open_trouble().c_str();
  const std::string now = device->device->last_words();
  device->words = device->trouble;
  if (!now.empty() && now != device->trouble) device->words += (device->trouble.empty() ? "" : "; ") + now;
  return device->words.c_str();
}

hdev_status kit_rt_attach(hdev* device) {
  device->device->attach();
  return HDEV_OK;
}

hdev_status kit_read(hdev* device, hdev_state* state, std::uint32_t) {
  hdev_state full{};
  full.R[0] = full.R[4] = full.R[8] = 1.0;
  full.temperature = -1.0;
  full.cal = HDEV_CAL_OK;
  const hdev_status status = device->device->read(full);
  if (status == HDEV_OK || status == HDEV_E_FAULT) hand_out(state, full);
  return status;
}

hdev_status kit_write(hdev* device, const hdev_command* command) {
  hdev_command known{};
  std::memcpy(&known, command, std::min<std::size_t>(command->size, sizeof known));
  kit::Effort effort;
  std::memcpy(effort.force, known.force, sizeof effort.force);
  std::memcpy(effort.torque, known.torque, sizeof effort.torque);
  if (!limit_norm(effort.force, device->info.max_force) ||
      !limit_norm(effort.torque, device->info.max_torque))
    return HDEV_E_ARG;
  return device->device->write(effort);
}

hdev_status kit_stop(hdev* device) { return device->device->stop(); }

hdev_status kit_emergency_stop(hdev* device, std::uint32_t within_us) {
  return device->device->emergency_stop(within_us);
}

hdev_status kit_rescue(const hdev_host* host, const char* id, const char* const* kv, std::uint32_t n_kv) {
  if (host == nullptr) return HDEV_E_ARG;
  return answer(open_trouble(), [&] {
    kit::Options options(kv, n_kv);
    kit::this_driver().rescue(*host, id == nullptr ? "" : id, options);
  });
}

hdev_status kit_motors_off(hdev* device) { return device->device->motors_are_off() ? HDEV_OK : HDEV_E_AGAIN; }

}  // namespace

extern "C" const hdev_api* hdev_plugin_query(std::uint32_t host_major, std::uint32_t) {
  static const hdev_api api = {sizeof(hdev_api),
                               HDEV_ABI_MAJOR,
                               HDEV_ABI_MINOR,
                               0,
                               kit::this_driver().name,
                               kit::this_driver().version,
                               kit_enumerate,
                               kit_open,
                               kit_get_info,
                               kit_calibrate,
                               kit_enable_force,
                               kit_close,
                               kit_last_error,
                               kit_rt_attach,
                               kit_read,
                               kit_write,
                               kit_stop,
                               kit_emergency_stop,
                               kit::this_driver().rescue == nullptr ? nullptr : kit_rescue,
                               kit_motors_off};
  return host_major == HDEV_ABI_MAJOR ? &api : nullptr;
}
