#pragma once
// A thread of a stranger's library that does wrong when the test asks for it: the crashes are real ones.

#include <sys/mman.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/support/devices/stranger_bus.h"

namespace palpate::test {

[[gnu::noinline]] inline void read_from_nowhere() {
  volatile int* volatile nowhere = nullptr;
  *nowhere = 1;
}

// Deeper and deeper; the volatile bytes keep the compiler from making a loop of it.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winfinite-recursion"
[[gnu::noinline]] inline int run_over_the_stack(volatile char* above) {
  volatile char here[4096];
  here[0] = static_cast<char>(above[0] + 1);
  return run_over_the_stack(here) + here[0];
}
#pragma GCC diagnostic pop

[[gnu::noinline]] inline void divide_by_nothing() {
  volatile int nothing = 0, one = 1;
  one = one / nothing;
}

[[gnu::noinline]] inline void read_behind_the_end() {
  const int file = open("/dev/shm", O_TMPFILE | O_RDWR, 0600);
  void* memory = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  *static_cast<volatile char*>(memory) = 1;
}

inline void do_wrong(std::uint32_t trouble) {
  volatile char start[1] = {0};
  switch (trouble) {
    case StrangerBus::own_thread:
      return read_from_nowhere();
    case StrangerBus::own_stack:
      run_over_the_stack(start);
      return;
    case StrangerBus::own_abort:
      return std::abort();
    case StrangerBus::own_arithmetic:
      return divide_by_nothing();
    case StrangerBus::own_instruction:
      return __builtin_trap();
    case StrangerBus::own_bus:
      return read_behind_the_end();
    case StrangerBus::own_exit:
      std::exit(3);
    default:
      return;
  }
}

/// Started once in each process that opens the device; never ends.
inline void keep_a_troubled_thread() {
  static const bool once = [] {
    std::thread([] {
      for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
        if (stranger_bus().owner.load() == getpid()) do_wrong(stranger_bus().trouble.load());
    }).detach();
    return true;
  }();
  static_cast<void>(once);
}

inline bool asked_to(StrangerBus::Trouble trouble) {
  return stranger_bus().trouble.load() == trouble && stranger_bus().owner.load() == getpid();
}

/// Where a call never comes back, whoever makes it, once there is so much trouble.
inline void perhaps_hang_from(StrangerBus::Trouble least) {
  while (stranger_bus().trouble.load() >= least && stranger_bus().owner.load() == getpid())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// Where a servo thread stands still, if it was asked to.
inline void perhaps_stand_still() {
  while (asked_to(StrangerBus::switch_hangs) || asked_to(StrangerBus::switch_crashes))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// Where the call that switches motors off never comes back, if it was asked to.
inline void perhaps_never_return() {
  if (asked_to(StrangerBus::switch_crashes)) read_from_nowhere();
  while (asked_to(StrangerBus::switch_hangs)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace palpate::test
