// See stub_dhd.h. Values of constants are written out here again, so that driver and stand-in cannot share a mistake.
#include "tests/support/devices/stub_dhd.h"

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>

namespace {

using palpate::test::StubDhd;
using palpate::test::StubDhdDevice;

constexpr int n_devices = 2;
constexpr int most_status = 17;
thread_local const char* last_error = "no error";  // each thread has its own, as with the vendor

class Stub final : public StubDhd {
 public:
  Stub() { Stub::reset(); }
  void reset() override {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    for (auto& one : devices) one = {};
    broken.clear();
    called.clear();
    last_error = "no error";
  }
  StubDhdDevice& device(int i) override { return devices.at(static_cast<std::size_t>(i)); }
  std::vector<std::string> breaches() override {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    return broken;
  }
  std::vector<std::string> calls() override {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    return called;
  }
  bool stop_comes(int i) override {
    std::unique_lock<std::recursive_mutex> lock(mutex);
    return changed.wait_for(lock, std::chrono::seconds(20), [&] { return device(i).stopped; });
  }

  /// The device that a call is about. The default -1 means the one opened last, which only works by luck with two.
  StubDhdDevice* subject(const char* function, char id) {
    if (id < 0) broken.push_back(std::string(function) + " without the number of a device");
    if (id < 0 || id >= n_devices || !devices[static_cast<std::size_t>(id)].open) {
      broken.push_back(std::string(function) + " of a device that is not open");
      return nullptr;
    }
    auto& one = devices[static_cast<std::size_t>(id)];
    if (one.connected) return &one;
    last_error = "communication error";
    return nullptr;
  }
  int refuse(const char* words) {
    last_error = words;
    return -1;
  }

  std::recursive_mutex mutex;
  std::condition_variable_any changed;
  std::array<StubDhdDevice, n_devices> devices;
  std::vector<std::string> broken, called;
  bool expert = false;
};

Stub& stub() {
  static Stub one;
  return one;
}

using Lock = std::lock_guard<std::recursive_mutex>;

int copy3(const std::array<double, 3>& from, double* x, double* y, double* z) {
  *x = from[0];
  *y = from[1];
  *z = from[2];
  return 0;
}

}  // namespace

#define EXPORT extern "C" __attribute__((visibility("default")))

EXPORT StubDhd* stub_dhd() { return &stub(); }

EXPORT int dhdGetAvailableCount() { return n_devices; }
EXPORT int dhdOpenID(char id) {
  const Lock lock(stub().mutex);
  if (id < 0 || id >= n_devices) return stub().refuse("no device found");
  auto& device = stub().devices[static_cast<std::size_t>(id)];
  if (device.open) return stub().refuse("device already in use");
  if (!device.opens || !device.connected) return stub().refuse("no device found");
  device.open = true;
  stub().called.push_back("open " + std::to_string(id));
  return id;
}
EXPORT int dhdOpen() { return dhdOpenID(0); }
EXPORT int dhdClose(char id) {
  const Lock lock(stub().mutex);
  if (id < 0 || id >= n_devices || !stub().devices[static_cast<std::size_t>(id)].open) {
    stub().broken.push_back("dhdClose of a device that is not open");
    return -1;
  }
  auto& device = stub().devices[static_cast<std::size_t>(id)];
  if (device.connected && device.force_on) stub().broken.push_back("dhdClose with forces on");
  device.open = false;
  stub().called.push_back("close " + std::to_string(id));
  return 0;
}
EXPORT int dhdStop(char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdStop", id);
  if (device == nullptr) return -1;
  device->stopped = true;
  device->force_on = false;
  device->effort = {};
  stub().changed.notify_all();
  return 0;
}
EXPORT int dhdGetSystemType(char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdGetSystemType", id);
  return device == nullptr ? -1 : device->type;
}
EXPORT const char* dhdGetSystemName(char) { return "stub.3"; }
EXPORT int dhdGetSerialNumber(unsigned short* serial, char) {
  *serial = 40123;
  return 0;
}
EXPORT void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
  *major = 3;
  *minor = 17;
  *release = 5;
  *revision = 0;
}
EXPORT const char* dhdErrorGetLastStr() { return last_error; }
EXPORT int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double (*r)[3], char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdGetPositionAndOrientationFrame", id);
  if (device == nullptr || device->measure_answer < 0) return -1;
  copy3(device->position, x, y, z);
  for (std::size_t i = 0; i < 9; ++i) r[i / 3][i % 3] = device->frame[i];
  return device->measure_answer;
}
EXPORT int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdGetLinearVelocity", id);
  if (device == nullptr || device->measure_answer < 0) return -1;
  copy3(device->velocity, x, y, z);
  return device->measure_answer;
}
EXPORT int dhdGetAngularVelocityRad(double* x, double* y, double* z, char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdGetAngularVelocityRad", id);
  return device == nullptr ? -1 : copy3(device->angular_velocity, x, y, z);
}
EXPORT int dhdGetGripperGap(double* gap, char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdGetGripperGap", id);
  if (device == nullptr) return -1;
  *gap = device->gap;
  return 0;
}
EXPORT unsigned int dhdGetButtonMask(char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdGetButtonMask", id);
  return device == nullptr ? 0u : device->buttons;
}
EXPORT int dhdSetForceAndTorque(double fx, double fy, double fz, double tx, double ty, double tz, char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdSetForceAndTorque", id);
  if (device == nullptr) return -1;
  const double f = std::hypot(fx, fy, fz);
  if (f != 0 && !device->force_on && !device->stopped && device->force_off_cause == 0)
    stub().broken.push_back("a force before forces are on");
  if (!(f <= 12 * (1 + 1e-12)) && device->type == 33)
    stub().broken.push_back("more than the device can bear");
  device->effort = {fx, fy, fz, tx, ty, tz};
  ++device->forces_set;
  return f > 10 ? 2 : 0;  // DHD_MOTOR_SATURATED, which is no error
}
EXPORT int dhdEnableForce(unsigned char on, char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdEnableForce", id);
  if (device == nullptr) return -1;
  for (const double f : device->effort)
    if (f != 0 && on != 0) stub().broken.push_back("forces switched on with a force");
  if ((on != 0) != device->force_on)
    stub().called.push_back((on != 0 ? "forces on " : "forces off ") + std::to_string(id));
  device->force_on = on != 0;
  if (on != 0) device->stopped = false;
  return 0;
}
EXPORT int dhdSetGravityCompensation(int on, char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdSetGravityCompensation", id);
  if (device == nullptr) return -1;
  device->gravity = on != 0;
  return 0;
}
EXPORT int dhdSetMaxForce(double newton, char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdSetMaxForce", id);
  if (device == nullptr) return -1;
  device->max_force = newton;
  return 0;
}
EXPORT int dhdGetStatus(int* status, char id) {
  const Lock lock(stub().mutex);
  if (id < 0 || id >= n_devices || !stub().devices[static_cast<std::size_t>(id)].open)
    stub().broken.push_back("dhdGetStatus of a device that is not open");
  const auto& device = stub().devices[static_cast<std::size_t>(id < 0 || id >= n_devices ? 0 : id)];
  for (int i = 0; i < most_status; ++i) status[i] = 0;
  status[0] = device.powered;
  status[1] = device.connected;
  status[2] = 1;
  status[3] = device.resetting;
  status[5] = device.force_on;
  status[8] = device.wrist;
  status[9] = device.error;
  status[12] = device.wrist_ready;
  status[14] = device.force_off_cause;
  return 0;
}
EXPORT int dhdEnableExpertMode() {
  const Lock lock(stub().mutex);
  stub().expert = true;
  return 0;
}
#ifndef STUB_DHD_OLD
EXPORT int dhdSetWatchdog(unsigned char duration, char id) {
  const Lock lock(stub().mutex);
  StubDhdDevice* device = stub().subject("dhdSetWatchdog", id);
  if (device == nullptr) return -1;
  if (!stub().expert) stub().broken.push_back("dhdSetWatchdog without expert mode");
  if (!device->has_watchdog) return stub().refuse("feature not available");
  device->watchdog = duration;
  return 0;
}
#endif
