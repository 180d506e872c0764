// A team: every piece once, no waiting for a thread that has not come, nothing spent while there is nothing to do.

#include "physics_node/step/team.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace palpate::physics {
namespace {

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

TEST(Team, DoesEveryPieceOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    Team team(threads);
    ASSERT_EQ(team.threads(), threads);
    for (int call = 0; call < 2000; ++call) {
      const auto count = static_cast<std::size_t>(call % 41);
      std::array<std::atomic<int>, 41> done{};
      team.each(count, threads, [&](std::size_t n) { ++done.at(n); });
      for (std::size_t n = 0; n < done.size(); ++n)
        ASSERT_EQ(done[n], n < count ? 1 : 0) << threads << " " << call;
    }
  }
}

/// What the pieces of one call wrote without atomics is there after it, for the caller and for the next call.
TEST(Team, LeavesWhatItDidToTheNextCall) {
  Team team(3);
  std::vector<long> last(32, 0), now(32, 0);
  for (int call = 0; call < 20000; ++call) {
    team.each(now.size(), 3, [&](std::size_t n) { now[n] = last[(n + 1) % last.size()] + 1; });
    std::swap(last, now);
  }
  for (const long value : last) EXPECT_EQ(value, 20000);
}

/// A worker holds piece after piece until all others are done: the caller has to do them, whatever keeps the worker.
TEST(Team, DoesNotWaitForAThreadThatHasNotCome) {
  Team team(2);
  const std::thread::id caller = std::this_thread::get_id();
  for (int call = 0; call < 50; ++call) {
    std::atomic<int> left{15};
    std::atomic<int> by_caller{0};
    team.each(16, 2, [&](std::size_t) {
      if (std::this_thread::get_id() == caller) {
        ++by_caller;
        --left;
        return;
      }
      while (left > 0) std::this_thread::yield();  // as long as it takes: this thread does one piece at most
    });
    EXPECT_GE(by_caller, 15);
  }
}

TEST(Team, UsesNoMoreThreadsThanAsked) {
  Team team(4);
  for (int call = 0; call < 200; ++call) {
    std::array<std::thread::id, 64> who{};
    team.each(who.size(), 1, [&](std::size_t n) { who.at(n) = std::this_thread::get_id(); });
    EXPECT_EQ(std::set<std::thread::id>(who.begin(), who.end()), std::set{std::this_thread::get_id()});
  }
}

TEST(Team, SpendsNothingWhileIdle) {
  Team team(8);
  std::atomic<int> pieces{0};
  team.each(64, 8, [&](std::size_t) { ++pieces; });
  const double before = cpu_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  // Seven workers that spun on would take 3.5 s, or all that the cores have; they spin for 50 us each.
  EXPECT_LT(cpu_seconds() - before, 0.05);
  EXPECT_EQ(pieces, 64);
}

/// The caller sleeps as well: what it waits for may need its core.
TEST(Team, SpendsNothingWhileItWaitsForAPiece) {
  Team team(2);
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> worker_has_one{false};
  const double before = cpu_seconds();
  team.each(2, 2, [&](std::size_t) {
    if (std::this_thread::get_id() == caller) {
      while (!worker_has_one) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return;
    }
    worker_has_one = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  });
  EXPECT_LT(cpu_seconds() - before, 0.05);
}

TEST(Team, LeavesSignalsToTheCaller) {
  sigset_t mask;
  sigset_t own;
  pthread_sigmask(SIG_SETMASK, nullptr, &own);
  Team team(2);
  std::atomic<int> blocked{-1};
  const std::thread::id caller = std::this_thread::get_id();
  for (int tries = 0; tries < 1000 && blocked < 0; ++tries)
    team.each(2, 2, [&](std::size_t) {
      if (std::this_thread::get_id() == caller) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return;
      }
      pthread_sigmask(SIG_SETMASK, nullptr, &mask);
      blocked = sigismember(&mask, SIGTERM);
    });
  EXPECT_EQ(blocked, 1);
  pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  EXPECT_EQ(sigismember(&mask, SIGTERM), sigismember(&own, SIGTERM));
}

}  // namespace
}  // namespace palpate::physics
