// libdhd once more, by another hand: written from the vendor's documentation only. One device, whose own watchdog is broken,
// so that only what is told counts. One lock for every call, as for one USB transfer after the other. See stranger_bus.h.

#include <cmath>
#include <cstring>
#include <mutex>

#include "tests/support/devices/stranger_bus.h"
#include "tests/support/devices/stranger_trouble.h"

namespace {

using palpate::test::stranger_bus;
using palpate::test::StrangerBus;

std::mutex transfer;
bool is_open = false;
std::int64_t on_since_ns = 0;

struct Transfer {
  explicit Transfer(const char* function, char id) : lock(transfer) {
    if (id != 0 || !is_open) stranger_bus().breach(function);
  }
  std::lock_guard<std::mutex> lock;
};

}  // namespace

#define EXPORT extern "C" __attribute__((visibility("default")))

EXPORT int dhdGetAvailableCount() { return 1; }
EXPORT int dhdOpenID(char id) {
  const std::lock_guard<std::mutex> lock(transfer);
  if (id != 0 || is_open || !stranger_bus().take_hold()) return -1;
  palpate::test::keep_a_troubled_thread();
  is_open = true;
  return 0;
}
EXPORT int dhdOpen() { return dhdOpenID(0); }
EXPORT int dhdClose(char id) {
  const Transfer one("dhdClose of no device", id);
  if (stranger_bus().motors.load()) stranger_bus().breach("dhdClose with forces on");
  is_open = false;
  stranger_bus().send(StrangerBus::closed);
  stranger_bus().owner.store(0);
  return 0;
}
EXPORT int dhdStop(char id) {
  palpate::test::perhaps_hang_from(StrangerBus::all_hang);
  const Transfer one("dhdStop of no device", id);
  stranger_bus().motors.store(false);
  stranger_bus().send(StrangerBus::motors_off);
  return 0;
}
EXPORT int dhdGetSystemType(char) { return 33; }
EXPORT const char* dhdGetSystemName(char) { return "stranger"; }
EXPORT int dhdGetSerialNumber(unsigned short* serial, char) { return *serial = 1, 0; }
EXPORT void dhdGetSDKVersion(int* a, int* b, int* c, int* d) { *a = 3, *b = 17, *c = 0, *d = 0; }
EXPORT const char* dhdErrorGetLastStr() { return "stranger's error"; }
EXPORT int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double (*r)[3], char id) {
  const Transfer one("dhdGetPosition... of no device", id);
  if (stranger_bus().trouble.load() == StrangerBus::servo_in_frame) palpate::test::read_from_nowhere();
  const std::int64_t now_ns = palpate::test::bus_time_ns();
  const double t = on_since_ns == 0 ? 0 : 1e-9 * static_cast<double>(now_ns - on_since_ns);
  *x = *y = 0;
  *z = -1e-3 * stranger_bus().depth_after(t);
  for (int i = 0; i < 9; ++i) r[i / 3][i % 3] = i % 4 == 0 ? 1 : 0;
  return 0;
}
EXPORT int dhdGetLinearVelocity(double* x, double* y, double* z, char) { return *x = *y = *z = 0, 0; }
EXPORT int dhdGetAngularVelocityRad(double* x, double* y, double* z, char) { return *x = *y = *z = 0, 0; }
EXPORT int dhdGetGripperGap(double* gap, char) { return *gap = 0, 0; }
EXPORT unsigned int dhdGetButtonMask(char) { return 0; }
EXPORT int dhdSetForceAndTorque(double fx, double fy, double fz, double, double, double, char id) {
  palpate::test::perhaps_hang_from(StrangerBus::end_hangs);
  const Transfer one("dhdSetForceAndTorque of no device", id);
  if (stranger_bus().trouble.load() == StrangerBus::servo_outside) palpate::test::read_from_nowhere();
  stranger_bus().force.store(std::hypot(fx, fy, fz));
  stranger_bus().send(StrangerBus::force_told);
  return 0;
}
EXPORT int dhdEnableForce(unsigned char on, char id) {
  palpate::test::perhaps_hang_from(StrangerBus::end_and_disable_hang);
  const Transfer one("dhdEnableForce of no device", id);
  palpate::test::perhaps_never_return();
  if (on != 0 && stranger_bus().force.load() != 0) stranger_bus().breach("forces switched with a force");
  if (on != 0 && on_since_ns == 0) on_since_ns = palpate::test::bus_time_ns();
  stranger_bus().motors.store(on != 0);
  stranger_bus().send(on != 0 ? StrangerBus::motors_on : StrangerBus::motors_off);
  return 0;
}
EXPORT int dhdSetGravityCompensation(int, char) { return 0; }
EXPORT int dhdSetMaxForce(double, char) { return 0; }
EXPORT int dhdGetStatus(int* status, char id) {
  const Transfer one("dhdGetStatus of no device", id);
  std::memset(status, 0, 17 * sizeof *status);
  status[0] = status[1] = 1;
  status[5] = stranger_bus().motors.load() ? 1 : 0;
  return 0;
}
EXPORT int dhdEnableExpertMode() { return 0; }
EXPORT int dhdSetWatchdog(unsigned char, char) { return 0; }
