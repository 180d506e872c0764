// See stub_hd.h. Values of constants are written out here again, so that driver and stand-in cannot share a mistake.
#include "tests/support/devices/stub_hd.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

namespace {

using palpate::test::StubHd;
using palpate::test::StubHdDevice;

constexpr unsigned int n_devices = 2;
constexpr unsigned int force_output = 0x4000, max_force_clamping = 0x4001, force_ramping = 0x4002;

struct Error {
  unsigned int code;
  int internal;
  unsigned int device;
};
struct Scheduled {
  unsigned long handle;
  unsigned int (*callback)(void*);
  void* user;
};

thread_local bool in_callback = false;

class Stub final : public StubHd {
 public:
  Stub() { Stub::reset(); }
  ~Stub() override { stop(); }

  void reset() override {
    stop();
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    for (auto& one : devices) one = {};
    devices[0].name = "Default PHANToM";
    devices[1].name = "left";
    devices[1].output_dof = 6;
    errors.clear();
    scheduled.clear();
    broken.clear();
    called.clear();
    silent = false;
    firm_frames = 0;
    for (auto& list : raised) list.clear();
    current = ~0u;
    pressing_since = -1;
    threaded = std::getenv("STUB_HD_PRESSES") != nullptr;
  }
  StubHdDevice& device(unsigned int i) override { return devices.at(i); }
  void tick(int n) override {
    for (int i = 0; i < n; ++i) run_callbacks();
  }
  void use_thread(bool yes) override { threaded = yes; }
  void raise(unsigned int i, unsigned int code) override {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    raised.at(i).push_back(code);
  }
  void fall_silent(bool yes) override { silent = yes; }
  std::vector<std::string> breaches() override {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    return broken;
  }
  std::vector<std::string> calls() override {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    return called;
  }

  void run_callbacks() {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    if (!running || silent) return;
    for (std::size_t i = 0; i < scheduled.size();) {
      in_callback = true;
      const bool again = scheduled[i].callback(scheduled[i].user) == 1;
      in_callback = false;
      for (unsigned int d = 0; d < n_devices; ++d)
        if (devices[d].in_frame) breach("a callback ends inside a frame");
      if (again)
        ++i;
      else
        scheduled.erase(scheduled.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  void start() {
    running = true;
    if (!threaded || thread.joinable()) return;
    thread = std::thread([this] {
      while (running) {
        press();
        make_trouble();
        run_callbacks();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  /// With $STUB_HD_PRESSES in the environment the hand goes down and up by that many mm in two seconds, again and again,
  /// once the forces are on. For tests that start whole programs.
  void press() {
    const char* depth = std::getenv("STUB_HD_PRESSES");
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    if (depth == nullptr || !devices[0].force_on) return;
    const double t = 1e-3 * devices[0].frames;
    if (pressing_since < 0) pressing_since = t;
    devices[0].transform[14] =
        -0.5 * std::atof(depth) * (1 - std::cos(3.14159265358979 * (t - pressing_since)));
  }
  void make_trouble() {
    const char* trouble = std::getenv("STUB_HD_TROUBLE");
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    StubHdDevice& hurt = devices[0];
    if (trouble == nullptr) return;
    if (firm_frames < 200) {
      if (std::hypot(hurt.force[0], hurt.force[1], hurt.force[2]) > 0.1) ++firm_frames;
      if (firm_frames == 200) note(std::string("trouble ") + trouble);
      return;
    }
    const std::string what = trouble;
    if (what == "silent") silent = true;
    if (what == "off" && hurt.force_on) hurt.force_on = false, note("forces off by itself");
    if (what == "warm" && hurt.temperature < 1) {
      hurt.temperature = std::min(1.0, std::max(hurt.temperature, 0.75) + 0.0002);
      if (hurt.temperature >= 1) raised[0].push_back(0x0200);
    }
  }
  /// Whoever waits for the vendor's thread.
  void wait_for_scheduler() const {
    while (silent) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void note(const std::string& what) {
    called.push_back(what);
    const char* file = std::getenv("STUB_HD_LOG");
    std::FILE* log = file == nullptr ? nullptr : std::fopen(file, "a");
    if (log == nullptr) return;
    std::fprintf(log, "%s\n", what.c_str());
    std::fclose(log);
  }
  void stop() {
    running = false;
    if (thread.joinable()) thread.join();
  }
  void breach(const std::string& what) { broken.push_back(what); }
  void fail(unsigned int code, int internal = 0) { errors.push_back({code, internal, current}); }

  /// The device that a call is about; `in_frame` asks for an open frame of it.
  StubHdDevice* subject(const char* function, bool in_frame) {
    if (current >= n_devices || !devices[current].open) {
      breach(std::string(function) + " without a current device");
      fail(0x0102);
      return nullptr;
    }
    if (in_frame && !devices[current].in_frame) breach(std::string(function) + " outside a frame");
    return &devices[current];
  }

  std::recursive_mutex mutex;
  std::array<StubHdDevice, n_devices> devices;
  std::array<std::vector<unsigned int>, n_devices> raised;
  std::deque<Error> errors;
  std::vector<Scheduled> scheduled;
  std::vector<std::string> broken, called;
  unsigned int current = ~0u;
  unsigned long next_handle = 0x100000001ul;  // does not fit 32 bits, like the real one
  std::atomic<bool> running{false}, silent{false};
  int firm_frames = 0;
  bool threaded = false;
  double pressing_since = -1;
  std::thread thread;
};

Stub& stub() {
  static Stub one;
  return one;
}

using Lock = std::lock_guard<std::recursive_mutex>;

}  // namespace

#define EXPORT extern "C" __attribute__((visibility("default")))

EXPORT StubHd* stub_hd() { return &stub(); }

EXPORT unsigned int hdInitDevice(const char* name) {
  const Lock lock(stub().mutex);
  stub().note(std::string("init ") + (name == nullptr ? "null" : name));
  if (stub().running) stub().breach("hdInitDevice while the scheduler runs");
  for (unsigned int i = 0; i < n_devices; ++i) {
    auto& device = stub().devices[i];
    if (name == nullptr || device.name != name) continue;
    stub().current = i;
    const unsigned int error = device.open ? 0x0301 : device.init_error;
    if (error != 0) {
      stub().fail(error, 7);
      return ~0u;
    }
    device.open = true;
    return i;
  }
  stub().fail(0x0302, 21);
  return ~0u;
}
EXPORT void hdDisableDevice(unsigned int handle) {
  const Lock lock(stub().mutex);
  stub().note("disable device " + std::to_string(handle));
  if (handle >= n_devices || !stub().devices[handle].open)
    return stub().breach("hdDisableDevice of no device");
  if (stub().devices[handle].force_on) stub().breach("hdDisableDevice with its forces on");
  stub().devices[handle].open = false;
}
EXPORT void hdMakeCurrentDevice(unsigned int handle) {
  const Lock lock(stub().mutex);
  if (handle >= n_devices) stub().breach("hdMakeCurrentDevice of no device");
  stub().current = handle;
}
EXPORT void hdBeginFrame(unsigned int handle) {
  const Lock lock(stub().mutex);
  if (handle >= n_devices || !stub().devices[handle].open) return stub().breach("hdBeginFrame of no device");
  auto& device = stub().devices[handle];
  if (device.in_frame) stub().breach("hdBeginFrame twice");
  device.in_frame = true;
  ++device.frames;
  if (device.unplugged) stub().fail(0x0302, 3);
}
EXPORT void hdEndFrame(unsigned int handle) {
  const Lock lock(stub().mutex);
  if (handle >= n_devices || !stub().devices[handle].in_frame)
    return stub().breach("hdEndFrame without a frame");
  stub().devices[handle].in_frame = false;
  for (const unsigned int code : stub().raised[handle]) stub().fail(code);
  stub().raised[handle].clear();
}
EXPORT Error hdGetError() {
  const Lock lock(stub().mutex);
  if (stub().errors.empty()) return {0, 0, ~0u};
  const Error error = stub().errors.front();
  stub().errors.pop_front();
  return error;
}
EXPORT const char* hdGetErrorString(unsigned int code) {
  return code == 0x0302   ? "Device communication error"
         : code == 0x0301 ? "Device already initiated"
                          : "Stub error";
}
EXPORT void hdEnable(unsigned int what) {
  const Lock lock(stub().mutex);
  StubHdDevice* device = stub().subject("hdEnable", false);
  if (device == nullptr) return;
  if (what == max_force_clamping) device->clamping = true;
  if (what == force_ramping) device->ramping = true;
  if (what != force_output) return;
  stub().note("forces on");
  if (device->calibration != 0x5000) stub().breach("forces on before the calibration");
  if (!device->clamping || !device->ramping) stub().breach("forces on without clamping and ramping");
  for (const double f : device->force)
    if (f != 0) stub().breach("forces on with a force");
  device->force_on = true;
}
EXPORT void hdDisable(unsigned int what) {
  const Lock lock(stub().mutex);
  StubHdDevice* device = stub().subject("hdDisable", false);
  if (device == nullptr) return;
  if (what == max_force_clamping) device->clamping = false;
  if (what == force_ramping) device->ramping = false;
  if (what != force_output) return;
  if (device->force_on) stub().note("forces off");
  // Beside a scheduler that calls back no more, or hangs, the motors come first.
  for (const double f : device->force)
    if (f != 0 && !device->unplugged && in_callback) stub().breach("forces off without zero before");
  device->force_on = false;
}
EXPORT unsigned char hdIsEnabled(unsigned int what) {
  const Lock lock(stub().mutex);
  StubHdDevice* device = stub().subject("hdIsEnabled", false);
  return what == force_output && device != nullptr && device->force_on ? 1 : 0;
}
EXPORT void hdGetDoublev(unsigned int what, double* to) {
  const Lock lock(stub().mutex);
  const bool present = what == 0x2051 || what == 0x2052 || what == 0x2053 || what == 0x2050;
  StubHdDevice* device = stub().subject("hdGetDoublev", present);
  if (device == nullptr) return;
  static const std::array<double, 6> box{-210, -110, -85, 210, 205, 130};
  switch (what) {
    case 0x2051:
      std::memcpy(to, device->velocity.data(), sizeof device->velocity);
      break;
    case 0x2052:
      std::memcpy(to, device->transform.data(), sizeof device->transform);
      break;
    case 0x2053:
      std::memcpy(to, device->angular_velocity.data(), sizeof device->angular_velocity);
      break;
    case 0x2551:
      std::memcpy(to, box.data(), sizeof box);
      break;
    case 0x2602:
      *to = 0.5;  // N/mm
      break;
    case 0x2603:
      *to = 3.3;
      break;
    case 0x2604:
      *to = 0.88;
      break;
    case 0x2605:
      for (int i = 0; i < 6; ++i) to[i] = i == 4 ? device->temperature : 0.1;
      break;
    case 0x2622:
      *to = 188;  // mN m
      break;
    default:
      stub().fail(0x0100);
  }
}
EXPORT void hdGetIntegerv(unsigned int what, int* to) {
  const Lock lock(stub().mutex);
  StubHdDevice* device = stub().subject("hdGetIntegerv", false);
  if (device == nullptr) return;
  if (what == 0x2000)
    *to = device->buttons;
  else if (what == 0x2553)
    *to = 6;
  else if (what == 0x2554)
    *to = device->output_dof;
  else if (what == 0x2555)
    *to = device->calibration_style;
  else
    stub().fail(0x0100);
}
EXPORT const char* hdGetString(unsigned int what) {
  return what == 0x2501 ? "Stub" : what == 0x2503 ? "palpate tests" : what == 0x2504 ? "0001" : "0.0";
}
EXPORT void hdSetDoublev(unsigned int what, const double* from) {
  const Lock lock(stub().mutex);
  StubHdDevice* device = stub().subject("hdSetDoublev", true);
  if (device == nullptr) return;
  if (what != 0x2700 && what != 0x2701) return stub().fail(0x0100);
  if (device->unplugged) return;
  auto& target = what == 0x2700 ? device->force : device->torque;
  std::memcpy(target.data(), from, sizeof target);
  const double limit = what == 0x2700 ? 3.3 : 188.0;
  if (!(std::hypot(target[0], target[1], target[2]) <= limit * (1 + 1e-9)))
    stub().breach("more than the device can bear");
}
EXPORT unsigned int hdCheckCalibration() {
  const Lock lock(stub().mutex);
  StubHdDevice* device = stub().subject("hdCheckCalibration", false);
  return device == nullptr ? 0u : device->calibration;
}
EXPORT void hdUpdateCalibration(unsigned int style) {
  const Lock lock(stub().mutex);
  StubHdDevice* device = stub().subject("hdUpdateCalibration", false);
  if (device == nullptr) return;
  stub().note("update calibration " + std::to_string(style));
  if (style != 1 && style != 2 && style != 4) stub().breach("hdUpdateCalibration of more than one style");
  if (device->calibrates_when_updated) device->calibration = 0x5000;
}
EXPORT unsigned long hdScheduleAsynchronous(unsigned int (*callback)(void*), void* user, unsigned short) {
  const Lock lock(stub().mutex);
  stub().scheduled.push_back({stub().next_handle, callback, user});
  return stub().next_handle++;
}
EXPORT void hdScheduleSynchronous(unsigned int (*callback)(void*), void* user, unsigned short) {
  stub().wait_for_scheduler();
  const Lock lock(stub().mutex);
  if (!stub().running) stub().breach("hdScheduleSynchronous while the scheduler rests");
  stub().run_callbacks();
  callback(user);
}
EXPORT void hdUnschedule(unsigned long handle) {
  stub().wait_for_scheduler();
  const Lock lock(stub().mutex);
  const auto had =
      std::erase_if(stub().scheduled, [&](const Scheduled& one) { return one.handle == handle; });
  if (had == 0) stub().breach("hdUnschedule of nothing");
}
EXPORT void hdSetSchedulerRate(unsigned long rate_Hz) {
  const Lock lock(stub().mutex);
  if (rate_Hz != 500 && rate_Hz != 1000) stub().fail(0x0101);
}
#ifndef STUB_HD_OLD
EXPORT void hdStartScheduler() { stub().start(); }
#endif
EXPORT void hdStopScheduler() {
  stub().wait_for_scheduler();
  stub().stop();
}
