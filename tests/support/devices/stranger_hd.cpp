// libHD once more, by another hand: written from the vendor's API reference only, with a servo thread of its own that keeps
// telling the hardware the last force, a scheduler that is locked while callbacks run, one error stack, and no patience with a
// wrong order of calls. Its hardware is stranger_bus.h.

#include <pthread.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>
#include <vector>

#include "tests/support/devices/stranger_bus.h"
#include "tests/support/devices/stranger_trouble.h"

namespace {

using palpate::test::stranger_bus;
using palpate::test::StrangerBus;

constexpr unsigned int the_device = 0;
constexpr unsigned int none = ~0u;

struct Error {
  unsigned int code;
  int internal;
  unsigned int device;
};
struct Callback {
  unsigned long handle;
  unsigned int (*function)(void*);
  void* user;
};

/// Called once by the servo thread, and waited for.
struct Once {
  unsigned int (*function)(void*);
  void* user;
  bool done = false;
};

struct Library {
  bool open = false, in_frame = false, calibration_looked_at = false, ramping = false, clamping = false;
  unsigned int current = none;
  double force[3]{};
  double since_on = -1;  // rounds of the servo thread since the motors are on
  std::vector<Error> errors;
  std::vector<Callback> callbacks;
  unsigned long next_handle = 0x7f0000000001ul;
  std::atomic<bool> running{false};
  std::thread servo;
  std::mutex scheduler;  // held while callbacks run
  std::vector<Once*> once;
  std::condition_variable served;
  std::atomic<int> inside{0};  // thread that is in the library now
};
Library& lib() {
  static Library* const one =
      new Library;  // never destroyed: the servo thread may run until the process ends
  return *one;
}

/// The library is not safe for two threads at once.
class Visit {
 public:
  Visit() {
    int nobody = 0;
    first_ = lib().inside.compare_exchange_strong(nobody, gettid());
    if (!first_ && nobody != gettid()) stranger_bus().breach("two threads in the library at once");
  }
  ~Visit() {
    if (first_) lib().inside.store(0);
  }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

 private:
  bool first_;
};

void fail(unsigned int code) { lib().errors.push_back({code, 0, lib().current}); }

bool has_device(const char* function) {
  if (lib().open && lib().current == the_device) return true;
  stranger_bus().breach(function);
  fail(0x0102);
  return false;
}

void tell_hardware() {
  stranger_bus().force.store(std::hypot(lib().force[0], lib().force[1], lib().force[2]));
  stranger_bus().send(StrangerBus::force_told);
}

void run_callbacks() {
  const std::lock_guard<std::mutex> lock(lib().scheduler);
  for (Once* one : lib().once) {
    one->function(one->user);
    one->done = true;
  }
  lib().once.clear();
  lib().served.notify_all();
  for (std::size_t i = 0; i < lib().callbacks.size();) {
    const Callback one = lib().callbacks[i];
    const bool again = one.function(one.user) == 1;
    if (lib().in_frame) stranger_bus().breach("a callback ends inside a frame");
    if (again)
      ++i;
    else
      lib().callbacks.erase(lib().callbacks.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

thread_local bool is_servo = false;

void serve() {
  is_servo = true;
  auto due = std::chrono::steady_clock::now();
  while (lib().running.load()) {
    palpate::test::perhaps_stand_still();
    run_callbacks();
    if (stranger_bus().motors.load()) {
      lib().since_on += 1;
      tell_hardware();  // whether there was a frame or not
    }
    if (stranger_bus().trouble.load() == StrangerBus::servo_outside) palpate::test::read_from_nowhere();
    due = std::max(due + std::chrono::milliseconds(1), std::chrono::steady_clock::now());
    std::this_thread::sleep_until(due);
  }
}

}  // namespace

#define EXPORT extern "C" __attribute__((visibility("default")))

EXPORT unsigned int hdInitDevice(const char* name) {
  const Visit visit;
  if (lib().running) stranger_bus().breach("hdInitDevice while the scheduler runs");
  if (name == nullptr || std::strcmp(name, "Default PHANToM") != 0 || lib().open) {
    fail(lib().open ? 0x0301 : 0x0302);
    return none;
  }
  if (!stranger_bus().take_hold()) {
    fail(0x0301);
    return none;
  }
  palpate::test::keep_a_troubled_thread();
  lib().open = true;
  lib().current = the_device;
  lib().since_on = -1;
  return the_device;
}
EXPORT void hdDisableDevice(unsigned int device) {
  palpate::test::perhaps_hang_from(StrangerBus::all_hang);
  if (palpate::test::asked_to(StrangerBus::end_and_disable_hang)) {
    stranger_bus().motors.store(false);
    return stranger_bus().send(StrangerBus::motors_off);
  }
  const Visit visit;
  if (device != the_device || !lib().open) return stranger_bus().breach("hdDisableDevice of no device");
  if (lib().running) stranger_bus().breach("hdDisableDevice while the scheduler runs");
  if (!lib().callbacks.empty()) stranger_bus().breach("hdDisableDevice with a callback");
  if (stranger_bus().motors.load()) stranger_bus().breach("hdDisableDevice with the motors on");
  lib().open = false;
  stranger_bus().send(StrangerBus::closed);
  stranger_bus().owner.store(0);
}
EXPORT void hdMakeCurrentDevice(unsigned int device) {
  const Visit visit;
  if (device != the_device || !lib().open) return stranger_bus().breach("hdMakeCurrentDevice of no device");
  lib().current = device;
}
EXPORT unsigned int hdGetCurrentDevice() { return lib().current; }
/// Frames are the servo thread's, as long as it runs.
static void frame_in(const char* function) {
  if (lib().running.load() && !is_servo) stranger_bus().breach(function);
}

EXPORT void hdBeginFrame(unsigned int device) {
  frame_in("hdBeginFrame beside the servo thread");
  while (palpate::test::asked_to(StrangerBus::begin_hangs))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Visit visit;
  if (device != the_device || !lib().open) return stranger_bus().breach("hdBeginFrame of no device");
  if (lib().in_frame) return fail(0x0400);
  lib().in_frame = true;
}
EXPORT void hdEndFrame(unsigned int device) {
  frame_in("hdEndFrame beside the servo thread");
  palpate::test::perhaps_hang_from(StrangerBus::end_hangs);
  const Visit visit;
  if (device != the_device || !lib().in_frame) return fail(0x0401);
  lib().in_frame = false;
  if (stranger_bus().motors.load()) tell_hardware();
}
EXPORT Error hdGetError() {
  if (lib().errors.empty()) return {0, 0, none};
  const Error newest = lib().errors.back();
  lib().errors.pop_back();
  return newest;
}
EXPORT const char* hdGetErrorString(unsigned int) { return "stranger's error"; }
EXPORT void hdEnable(unsigned int what) {
  const Visit visit;
  if (!has_device("hdEnable without a device")) return;
  if (what == 0x4001) lib().clamping = true;
  if (what == 0x4002) lib().ramping = true;
  if (what != 0x4000) return;
  if (!lib().calibration_looked_at) stranger_bus().breach("motors on before the calibration");
  if (!lib().clamping || !lib().ramping) stranger_bus().breach("motors on without clamping and ramping");
  for (const double f : lib().force)
    if (f != 0) stranger_bus().breach("motors on with a force");
  stranger_bus().motors.store(true);
  stranger_bus().send(StrangerBus::motors_on);
}
EXPORT void hdDisable(unsigned int what) {
  if (what == 0x4000) palpate::test::perhaps_hang_from(StrangerBus::end_and_disable_hang);
  const Visit visit;
  if (!has_device("hdDisable without a device")) return;
  if (what == 0x4001) lib().clamping = false;
  if (what == 0x4002) lib().ramping = false;
  if (what != 0x4000) return;
  palpate::test::perhaps_never_return();
  stranger_bus().motors.store(false);
  stranger_bus().send(StrangerBus::motors_off);
}
EXPORT unsigned char hdIsEnabled(unsigned int what) {
  return what == 0x4000 ? stranger_bus().motors.load() : what == 0x4001 ? lib().clamping : lib().ramping;
}
EXPORT void hdGetDoublev(unsigned int what, double* to) {
  const Visit visit;
  if (!has_device("hdGetDoublev without a device")) return;
  const bool measured = what >= 0x2050 && what <= 0x2053;
  if (measured && !lib().in_frame) return fail(0x0402);
  if (measured && stranger_bus().trouble.load() == StrangerBus::servo_in_frame)
    palpate::test::read_from_nowhere();
  static const double box[6] = {-200, -100, -80, 200, 200, 120};
  switch (what) {
    case 0x2051:
    case 0x2053:
      to[0] = to[1] = to[2] = 0;
      break;
    case 0x2052:
      for (int i = 0; i < 16; ++i) to[i] = i % 5 == 0 ? 1 : 0;
      to[14] = lib().since_on < 0 ? 0 : -stranger_bus().depth_after(1e-3 * lib().since_on);
      break;
    case 0x2551:
      std::memcpy(to, box, sizeof box);
      break;
    case 0x2602:
      *to = 0.5;
      break;
    case 0x2603:
      *to = 3.3;
      break;
    case 0x2604:
      *to = 1.4;
      break;
    case 0x2605:
      for (int i = 0; i < 3; ++i) to[i] = 0.2;
      break;
    default:
      fail(0x0100);
  }
}
EXPORT void hdGetIntegerv(unsigned int what, int* to) {
  const Visit visit;
  if (!has_device("hdGetIntegerv without a device")) return;
  *to = what == 0x2553 ? 6 : what == 0x2554 ? 3 : what == 0x2555 ? 2 : 0;
}
EXPORT const char* hdGetString(unsigned int) { return "stranger"; }
EXPORT void hdSetDoublev(unsigned int what, const double* from) {
  const Visit visit;
  if (!has_device("hdSetDoublev without a device")) return;
  if (!lib().in_frame) return fail(0x0402);
  if (what == 0x2700) std::memcpy(lib().force, from, sizeof lib().force);
}
EXPORT unsigned int hdCheckCalibration() {
  lib().calibration_looked_at = true;
  return 0x5000;
}
EXPORT void hdUpdateCalibration(unsigned int) {}
EXPORT unsigned long hdScheduleAsynchronous(unsigned int (*function)(void*), void* user, unsigned short) {
  const std::lock_guard<std::mutex> lock(lib().scheduler);
  lib().callbacks.insert(lib().callbacks.begin(), {lib().next_handle, function, user});
  return lib().next_handle++;
}
EXPORT void hdScheduleSynchronous(unsigned int (*function)(void*), void* user, unsigned short) {
  if (!lib().running) return stranger_bus().breach("hdScheduleSynchronous while the scheduler rests");
  Once once{function, user};
  std::unique_lock<std::mutex> lock(lib().scheduler);
  lib().once.push_back(&once);
  lib().served.wait(lock, [&once] { return once.done; });
}
EXPORT void hdUnschedule(unsigned long handle) {
  const std::lock_guard<std::mutex> lock(lib().scheduler);
  if (std::erase_if(lib().callbacks, [&](const Callback& one) { return one.handle == handle; }) == 0)
    stranger_bus().breach("hdUnschedule of nothing");
}
EXPORT void hdSetSchedulerRate(unsigned long rate) {
  if (rate != 500 && rate != 1000) fail(0x0101);
}
EXPORT void hdStartScheduler() {
  if (lib().running.exchange(true)) return;
  lib().servo = std::thread(serve);
}
EXPORT void hdStopScheduler() {
  lib().running.store(false);
  if (lib().servo.get_id() == std::this_thread::get_id())
    return stranger_bus().breach("hdStopScheduler in the servo thread");
  if (lib().servo.joinable()) lib().servo.join();
}
