// A tick takes no memory. Every way to operator new in this program is counted while a tick runs.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

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

}  // namespace
}  // namespace palpate::haptic::test
