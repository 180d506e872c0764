// A tick takes no memory. Every way to operator new in this program is counted while a tick runs.

#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <thread>

#include "common/scene/device_spec.h"
#include "common/wire/writer.h"
#include "tests/support/devices/stub_hd.h"
#include "tests/system/dds_domain.h"
#include "tests/unit/haptic_node/drivers/opened_driver.h"
#include "tests/unit/haptic_node/drivers/stub_library.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace {

thread_local bool in_tick = false;
thread_local std::size_t allocations = 0;

void* taken(std::size_t size) {
  if (in_tick) ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return taken(size); }
void* operator new[](std::size_t size) { return taken(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace palpate::haptic::test {
namespace {

TEST(AllocationCount, SeesAnAllocation) {
  in_tick = true;
  delete new int(3);
  in_tick = false;
  EXPECT_EQ(allocations, 1u);
  allocations = 0;
}

TEST(HapticSession, TakesNoMemoryInATickWhateverHappens) {
  VirtualWorld world(
      scene_with(HandModel::arm, {{0, {0, 0, 0.02}}, {0.5, {0, 0, -0.004}}, {2, {0.01, 0, 0.02}}}));
  allocations = 0;
  in_tick = true;
  world.run(1, 150);   // arm, approach, press
  world.run(0.5, 0);   // silence, fade
  world.run(1, 1000);  // return, retract
  world.now += 100'000'000;
  world.run(0.5, 1000);  // stall
  world.session.begin_stop();
  world.run(0.05, 1000);
  in_tick = false;
  EXPECT_EQ(allocations, 0u);
  EXPECT_TRUE(world.session.stopped());
}

/// 500 ticks of a driver that is open; `elsewhere` stands for the vendor's own thread.
template <class Elsewhere>
std::size_t taken_by(DriverUnderTest& driver, Elsewhere&& elsewhere) {
  EXPECT_EQ(driver.calibrate(), HDEV_OK);
  EXPECT_EQ(driver.power(true), HDEV_OK);
  allocations = 0;
  hdev_command command{};
  command.size = sizeof command;
  command.force[0] = 0.5;
  for (int i = 0; i < 500; ++i) {
    driver.now += 1'000'000;
    elsewhere();
    in_tick = true;
    const hdev_status read = driver.read();
    const hdev_status written = driver.api().write(driver.device(), &command);
    in_tick = false;
    EXPECT_EQ(read, HDEV_OK);
    EXPECT_EQ(written, HDEV_OK);
  }
  EXPECT_EQ(driver.state.force_enabled, 1u);
  return allocations;
}

TEST(Drivers, TakeNoMemoryInReadAndWrite) {
  const auto nobody = [] {};
  const std::string file =
      (std::filesystem::temp_directory_path() / ("palpate_quiet_" + std::to_string(getpid()))).string();
  std::ofstream(file) << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,1,2,3,0,0,0,1\n";
  DriverUnderTest simulated("simulated"), replay("replay"), hd_driver("openhaptics"),
      dhd_driver("forcedimension");
  auto& hd = stub_library<palpate::test::StubHd>(STUB_HD, "stub_hd");
  ASSERT_EQ(simulated.open({{"model", "touch"}}), HDEV_OK);
  ASSERT_EQ(replay.open({{"file", file}}), HDEV_OK);
  ASSERT_EQ(hd_driver.open({{"library", STUB_HD}}), HDEV_OK);
  ASSERT_EQ(dhd_driver.open({{"library", STUB_DHD}}), HDEV_OK);
  EXPECT_EQ(taken_by(simulated, nobody), 0u);
  EXPECT_EQ(taken_by(replay, nobody), 0u);
  EXPECT_EQ(taken_by(hd_driver, [&] { hd.tick(1); }), 0u);
  EXPECT_EQ(taken_by(dhd_driver, nobody), 0u);
  std::filesystem::remove(file);
}

TEST(Drivers, TakeNoMemoryWhileTheMousePoints) {
  DriverUnderTest mouse("mouse");
  Participant participant(palpate::test::own_domain());
  Writer<Pointer> window(participant);
  Pointer pointer;
  pointer.held = 1;
  const auto point = [&] {
    mouse.now -=
        500'000;  // half as fast: the window stays within its 500 ms of silence, however late it is heard
    pointer.tick += 1;
    pointer.p_W[0] += 1e-5;
    window.write(pointer);
  };
  ASSERT_EQ(mouse.open({{"domain", std::to_string(palpate::test::own_domain())}}), HDEV_OK);
  for (int i = 0; i < 10'000 && mouse.read() != HDEV_OK; ++i) {
    point();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(taken_by(mouse, point), 0u);
}

}  // namespace
}  // namespace palpate::haptic::test
