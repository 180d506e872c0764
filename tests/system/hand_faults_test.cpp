// What a hand feels when processes are killed, stopped, crash or end in the middle of a contact: the real programs, each
// write to the device looked at.

#include "tests/system/hand_session.h"
#include "tests/system/shell.h"

namespace palpate::test {
namespace {

class HandFaults : public HandSession {
 protected:
  bool note_says(const std::string& words) {
    return until([&] {
      NodeStatus status;
      while (statuses.take(status))
        if (status.node == NodeKind::haptic) newest = status;
      return std::string(newest.note.data()).find(words) != std::string::npos;
    });
  }

  Participant participant{domain};
  Reader<NodeStatus> statuses{participant};
  NodeStatus newest;
};

TEST_F(HandFaults, KilledPhysicsLeavesNoForceAndComesBackWithoutAKick) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  std::this_thread::sleep_for(500ms);  // tissue and planes come to rest
  const double held = force_now();
  kill(physics, SIGKILL);
  const std::int64_t killed_ns = now_ns();
  const std::uint64_t first = device->writes;
  end(physics, 0);
  ASSERT_TRUE(until([&] { return force_now() == 0.0; }));
  const std::uint64_t last = device->writes;
  double force = held + 1e-6;
  std::int64_t silent_ns = 0;
  for (std::uint64_t n = first; n < last; ++n) {
    const auto& write = device->at(n);
    if (silent_ns == 0 && write.norm == 0) silent_ns = write.t_ns;
    // Planes reach for the last patch for up to 100 ms; then nothing may rise.
    ASSERT_LE(write.norm, force + (write.t_ns < killed_ns + 100'000'000 ? 1e-3 : 1e-9)) << "write " << n;
    force = write.norm;
  }
  EXPECT_LE(seconds_from_ns(silent_ns - killed_ns), 0.4);
  RecordProperty("ms_to_no_force", static_cast<int>((silent_ns - killed_ns) / 1'000'000));

  start_physics();
  EXPECT_TRUE(until([this] { return std::filesystem::exists(folder / "out" / "record_1.h5"); }))
      << "what was recorded before is kept";
  ASSERT_TRUE(until([&] {
    NodeStatus status;
    while (statuses.take(status))
      if (status.node == NodeKind::physics && status.pid == static_cast<std::uint32_t>(physics) &&
          status.ticks > 0)
        return true;
    return false;
  })) << log();
  ASSERT_TRUE(note_says("")) << log();
  const std::uint64_t back_tick = newest.ticks;
  ASSERT_TRUE(note_says("inside the tissue")) << newest.note.data();
  // 0.3 s on a quiet machine; physics loads and answers in its own time where others compile.
  EXPECT_LT(newest.ticks, back_tick + 10'000)
      << "by the hand's own clock of 1 kHz, however late this test hears of it";
  EXPECT_EQ(force_now(), 0.0);
  ASSERT_TRUE(until([&] { return device->at(device->writes - 1).z > 0.021; }));
  ASSERT_TRUE(until([&] { return force_now() > 0.3 * held; }))
      << "felt again after it has left: " << newest.note.data();
  expect_no_kick();
}

TEST_F(HandFaults, AStoppedProcessComesBackWithoutBurstOrKick) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  std::atomic<bool> enough{false};
  std::thread hog([&] {
    while (!enough.load()) {
    }
  });
  for (const auto stop : {5ms, 50ms, 500ms}) {
    kill(haptic, SIGSTOP);
    std::this_thread::sleep_for(stop);
    kill(haptic, SIGCONT);
    const std::int64_t resumed_ns = now_ns();
    const std::uint64_t first = device->writes;
    EXPECT_TRUE(until([&] { return device->writes > first + 300; }));
    EXPECT_GE(now_ns() - resumed_ns, 290'000'000) << "ticks were made up for";
  }
  enough.store(true);
  hog.join();
  // The device's own watchdog: after 30 ms of silence it forces nothing.
  int silences = 0;
  for (std::uint64_t n = 1; n < device->writes; ++n) {
    const auto &before = device->at(n - 1), &now = device->at(n);
    if (before.powered == 0 || before.norm == 0 || now.t_ns - before.t_ns < 35'000'000) continue;
    ++silences;
    EXPECT_EQ(now.felt, 0.0);
  }
  EXPECT_GE(silences, 1);
  expect_no_kick();
}

TEST_F(HandFaults, EndsWithZeroForceAndMotorsOffWhenTold) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  const int status = end(haptic, SIGTERM);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << log();
  EXPECT_EQ(force_now(), 0.0);
  EXPECT_EQ(device->powered, 0u);
  EXPECT_GE(device->disabled, 1u);
  EXPECT_EQ(device->closed, 1u);
  expect_no_kick();
}

TEST_F(HandFaults, CrashesAndExitsWithMotorsOff) {
  setenv("PALPATE_WATCHED_TROUBLE", "1", 1);
  for (const std::uint32_t crash : {1u, 2u}) {
    start_both();
    ASSERT_TRUE(presses()) << log();
    ASSERT_EQ(device->powered, 1u);
    device->crash = crash;
    const int status = end(haptic, 0);
    if (crash == 1)
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGSEGV) << status;
    else
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3) << status;
    EXPECT_EQ(device->powered, 0u) << "crash " << crash;
    EXPECT_GE(device->stops, 1u);
    end(physics, SIGKILL);
    new (&*device) WatchedDevice;
  }
  unsetenv("PALPATE_WATCHED_TROUBLE");
}

/// The watched driver is of version 1.0 of the contract: it has stop() and no more.
TEST_F(HandFaults, EverySignalThatEndsTheNodeStopsTheMotorsOfAnOlderDriver) {
  start_physics();
  for (const int signal :
       {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP, SIGQUIT, SIGALRM, SIGUSR1, SIGUSR2,
        SIGVTALRM, SIGPROF, SIGXCPU, SIGPOLL, SIGSTKFLT, SIGRTMIN, SIGHUP, SIGPWR}) {
    haptic = start(PALPATE_HAPTIC);
    ASSERT_TRUE(until([this] { return device->powered == 1 && device->writes > 100; })) << log();
    const int status = end(haptic, signal);
    if (signal == SIGHUP || signal == SIGPWR)
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << signal << ": " << status;
    else
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << signal << ": " << status;
    EXPECT_EQ(device->powered, 0u) << signal;
    new (&*device) WatchedDevice;
  }
}

TEST_F(HandFaults, AnEmergencyStopIsLatchedKeptAsAFlightAndEndedByAPerson) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  device->estop = 1;
  ASSERT_TRUE(note_says("tip: fault"));
  EXPECT_EQ(device->powered, 0u);
  EXPECT_EQ(newest.phase, NodePhase::failed);
  EXPECT_EQ(newest.faults, 1u);
  const auto flight = folder / "out" / "flight_tip.csv";
  EXPECT_TRUE(until([&] { return log().find("flight_tip.csv") != std::string::npos; })) << log();
  EXPECT_GT(std::filesystem::file_size(flight), 10'000u);
  device->estop = 0;
  const std::string reset = quoted(PALPATE) + " reset tip --domain " + std::to_string(domain) + " >/dev/null";
  ASSERT_EQ(std::system(reset.c_str()), 0);
  ASSERT_TRUE(until([&] { return device->opened == 2; })) << log();
  EXPECT_EQ(device->closed, 1u);
  EXPECT_TRUE(note_says("tip: run")) << newest.note.data();
  expect_no_kick();
}

}  // namespace
}  // namespace palpate::test
