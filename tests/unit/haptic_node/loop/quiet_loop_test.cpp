// The loop thread takes no memory, no lock and no page once it is warm: counted while the real loop runs, beside threads
// that take both all the time. PALPATE_QUIET_SECONDS in the environment: how long; 3 s otherwise.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include "common/scene/device_spec.h"
#include "haptic_node/loop/realtime.h"
#include "tests/unit/haptic_node/loop/running_loop.h"
#include "tests/unit/haptic_node/loop/watched_world.h"

namespace {

std::atomic<pid_t> counted_thread{0};
std::atomic<std::uint64_t> allocations{0}, locks{0};

bool is_counted() {
  const pid_t thread = counted_thread.load(std::memory_order_relaxed);
  return thread != 0 && thread == gettid();
}

}  // namespace

// Every way to memory and to a mutex in this program.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t n, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) {
  if (is_counted()) allocations.fetch_add(1);
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  if (is_counted()) allocations.fetch_add(1);
  return __libc_calloc(n, size);
}
void* realloc(void* memory, std::size_t size) {
  if (is_counted()) allocations.fetch_add(1);
  return __libc_realloc(memory, size);
}
void free(void* memory) {
  if (memory != nullptr && is_counted()) allocations.fetch_add(1);
  __libc_free(memory);
}
int pthread_mutex_lock(pthread_mutex_t* mutex) {
  static const auto next =
      reinterpret_cast<int (*)(pthread_mutex_t*)>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  if (is_counted()) locks.fetch_add(1);
  return next(mutex);
}
}

namespace palpate::haptic::test {
namespace {

TEST(QuietLoop, TheCountersSeeAnAllocationAndALock) {
  std::mutex mutex;
  counted_thread.store(gettid());
  {
    const std::lock_guard lock(mutex);
    void* volatile memory = std::malloc(100);
    std::free(memory);
  }
  counted_thread.store(0);
  EXPECT_EQ(allocations.exchange(0), 2u);
  EXPECT_EQ(locks.exchange(0), 1u);
}

int seconds_to_watch() {
  const char* given = std::getenv("PALPATE_QUIET_SECONDS");
  return given == nullptr ? 3 : std::max(1, std::atoi(given));
}

/// In and out of the tissue twice a second.
std::vector<Waypoint> tapping(int seconds) {
  std::vector<Waypoint> path = {{0, {0, 0, 0.005}}};
  for (int i = 1; i < 4 * (seconds + 5); ++i) path.push_back({0.25 * i, {0, 0, i % 2 == 1 ? -0.002 : 0.005}});
  return path;
}

TEST(QuietLoop, TakesNoMemoryNoLockAndNoPageOnceItIsWarm) {
  const int seconds = seconds_to_watch();
  std::string why;
  lock_memory(why);
  palpate::test::WatchedFile file(watched_file(), palpate::test::WatchedFile::Role::test);
  RunningLoop running(watched(scene_with(HandModel::arm, tapping(seconds))));
  std::atomic<bool> end{false};
  std::mutex mutex;
  std::thread busy([&] {
    while (!end.load()) {
      const std::lock_guard lock(mutex);
      std::vector<int> memory(100'000, 1);
      std::this_thread::yield();
    }
  });
  running.live(1500ms, true);
  ASSERT_GT(file->loop_thread.load(), 0);
  const std::uint64_t before = running.last_tick;
  counted_thread.store(file->loop_thread.load());
  running.live(1000ms * seconds, true);
  counted_thread.store(0);
  end.store(true);
  busy.join();
  running.loop->finish();
  EXPECT_EQ(allocations.load(), 0u);
  EXPECT_EQ(locks.load(), 0u);
  EXPECT_EQ(running.loop->stats()->page_faults, 0u) << (why.empty() ? "with" : "without") << " memory locked";
  EXPECT_GT(running.last_tick, before + 100) << "it has ticked";
  EXPECT_GT(running.report.counts.energy_max, 0.0) << "it has been in contact";
}

}  // namespace
}  // namespace palpate::haptic::test
