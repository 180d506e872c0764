// Every way in which palpate-haptic may end, in contact, with every driver whose forces a hand can feel: the hardware is told
// no force, or off, within 30 ms, and the process ends as the signal has it. Hardware and libraries are a stranger's.

#include <array>
#include <csignal>
#include <vector>

#include "tests/support/devices/helper_process.h"
#include "tests/system/stranger_session.h"

namespace palpate::test {
namespace {

constexpr double limit_ms = 30;

struct Signal {
  int number;
  bool in_order = false;  // ends the node as SIGTERM does
};
const std::vector<Signal>& ending_signals() {
  static const std::vector<Signal> all = {
      {SIGSEGV},      {SIGABRT},       {SIGBUS},       {SIGFPE},      {SIGILL},   {SIGSYS},
      {SIGTRAP},      {SIGQUIT},       {SIGALRM},      {SIGUSR1},     {SIGUSR2},  {SIGVTALRM},
      {SIGPROF},      {SIGXCPU},       {SIGPOLL},      {SIGSTKFLT},   {SIGRTMIN}, {SIGRTMAX},
      {SIGHUP, true}, {SIGTERM, true}, {SIGINT, true}, {SIGPWR, true}};
  return all;
}
constexpr std::array ignored_signals = {SIGPIPE, SIGXFSZ, SIGTSTP, SIGTTIN, SIGTTOU, SIGCHLD, SIGURG};

class MotorsOff : public StrangerSession {
 protected:
  /// Strikes until the machine has been on time, so that a limit means the program. One that never is gets its own lateness added.
  Outcome struck_on_time(const std::function<void()>& blow, double within_ms = limit_ms) {
    Outcome outcome;
    for (int attempt = 0; attempt < 6; ++attempt) {
      if (!presses()) {
        ADD_FAILURE() << "no contact\n" << log();
        return outcome;
      }
      outcome = strike(blow);
      if (outcome.off_ms >= 0 && (outcome.off_ms <= within_ms || outcome.late_ms < 3)) break;
    }
    return outcome;
  }

  void every_signal() {
    ASSERT_TRUE(presses()) << log();
    for (const int signal : ignored_signals) kill(haptic, signal);
    std::this_thread::sleep_for(50ms);
    EXPECT_GT(bus->felt(), 0.3) << "neither ended nor stopped";
    strike([this] { kill(haptic, SIGTERM); });
    int met = 0;
    for (const auto& [number, in_order] : ending_signals()) {
      const Outcome outcome = struck_on_time([this, number = number] { kill(haptic, number); });
      if (HasFailure()) return;
      if (in_order)
        EXPECT_TRUE(WIFEXITED(outcome.status) && WEXITSTATUS(outcome.status) == 0) << number << "\n" << log();
      else
        EXPECT_TRUE(WIFSIGNALED(outcome.status) && WTERMSIG(outcome.status) == number)
            << number << ": " << outcome.status;
      check(outcome, "signal " + std::to_string(number));
      met += outcome.off_ms >= 0 && outcome.off_ms <= limit_ms + outcome.late_ms ? 1 : 0;
    }
    EXPECT_EQ(met, static_cast<int>(ending_signals().size()));
    EXPECT_EQ(breaches(), "");
  }

  void check(const Outcome& outcome, const std::string& what, double within_ms = limit_ms) {
    std::printf("  %-22s off after %6.2f ms, gone after %6.1f ms (machine late by %.1f ms)\n", what.c_str(),
                outcome.off_ms, outcome.gone_ms, outcome.late_ms);
    EXPECT_GE(outcome.off_ms, 0) << what << ": the motors stay on\n" << log();
    EXPECT_LE(outcome.off_ms, within_ms + outcome.late_ms) << what;
    EXPECT_TRUE(outcome.stayed_off) << what;
  }

  void true_crash(StrangerBus::Trouble trouble, int signal, const char* what) {
    const Outcome outcome = struck_on_time([this, trouble] { bus->trouble.store(trouble); });
    if (HasFailure()) return;
    EXPECT_TRUE(WIFSIGNALED(outcome.status) && WTERMSIG(outcome.status) == signal)
        << what << ": " << outcome.status;
    check(outcome, what);
  }

  /// exit() from a thread of the vendor's library.
  void exits() {
    const Outcome outcome = struck_on_time([this] { bus->trouble.store(StrangerBus::own_exit); });
    if (HasFailure()) return;
    EXPECT_TRUE(WIFEXITED(outcome.status) && WEXITSTATUS(outcome.status) == 3) << outcome.status;
    check(outcome, "exit()");
  }

  void every_true_crash() {
    exits();
    true_crash(StrangerBus::own_thread, SIGSEGV, "null pointer");
    true_crash(StrangerBus::own_stack, SIGSEGV, "stack overflow");
    true_crash(StrangerBus::own_abort, SIGABRT, "abort()");
    true_crash(StrangerBus::own_arithmetic, SIGFPE, "division by zero");
    true_crash(StrangerBus::own_instruction, SIGILL, "illegal instruction");
    true_crash(StrangerBus::own_bus, SIGBUS, "page of no file");
  }

  /// A call that hangs before the end comes: the motors are off by the library's own switch, whatever else does not work.
  void hangs_before(StrangerBus::Trouble trouble, int signal, const std::string& what) {
    constexpr double before_ms = 10;
    const Outcome outcome = struck_on_time(
        [&] {
          bus->trouble.store(trouble);
          std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(before_ms));
          kill(haptic, signal);
        },
        before_ms + limit_ms);
    if (HasFailure()) return;
    check(outcome, what, before_ms + limit_ms);
  }
  /// And where nobody ends anything: off within 30 ms of the fault, and only said to be where that is known.
  void hangs_alone(StrangerBus::Trouble trouble, double fault_ms, const std::string& what,
                   bool known = true) {
    static const std::string off = "; forces are off; ", perhaps_on = "; ITS MOTORS MAY STILL BE ON";
    bool said = false;
    const Outcome outcome = struck_on_time(
        [&] {
          bus->trouble.store(trouble);
          said = until([&] { return log().find(known ? off : perhaps_on) != std::string::npos; });
          EXPECT_EQ(bus->felt(), 0) << log();
          kill(haptic, SIGTERM);
        },
        fault_ms + limit_ms);
    EXPECT_TRUE(said) << log();
    EXPECT_EQ(log().find(known ? perhaps_on : off), std::string::npos) << log();
    if (!HasFailure()) check(outcome, what, fault_ms + limit_ms);
  }
  void nothing_works(double wait_s) {
    ASSERT_TRUE(presses()) << log();
    bool said = false;
    const Outcome outcome = strike(
        [&] {
          bus->trouble.store(StrangerBus::all_hang);
          said = until([this] { return log().find("MOTORS MAY STILL BE ON") != std::string::npos; });
          EXPECT_GT(bus->felt(), 0.1);
          kill(haptic, SIGTERM);
        },
        wait_s);
    EXPECT_TRUE(said) << log();
    EXPECT_EQ(log().find("forces are off"), std::string::npos) << log();
    EXPECT_GE(outcome.off_ms, 0) << "by the guardian\n" << log();
  }

  /// Past every handler: the guardian's turn. No limit but its own patience: it has to open the device first.
  void killed() {
    ASSERT_TRUE(presses()) << log();
    const Outcome outcome = strike([this] { kill(haptic, SIGKILL); }, 3);
    EXPECT_TRUE(WIFSIGNALED(outcome.status) && WTERMSIG(outcome.status) == SIGKILL);
    std::printf("  %-22s off after %6.2f ms, gone after %6.1f ms (machine late by %.1f ms)\n", "SIGKILL",
                outcome.off_ms, outcome.gone_ms, outcome.late_ms);
    EXPECT_GE(outcome.off_ms, 0) << log();
    EXPECT_TRUE(outcome.stayed_off);
    EXPECT_TRUE(until([this] {
      return log().find("palpate-guardian: palpate-haptic has died; the motors of") != std::string::npos;
    })) << log();
    ASSERT_TRUE(presses()) << "the device can be had again\n" << log();
    strike([this] { kill(haptic, SIGTERM); });
  }
};

class OpenHaptics : public MotorsOff {
  std::string device() const override { return "driver = \"openhaptics\"\nlibrary = \"" STRANGER_HD "\"\n"; }
};
TEST_F(OpenHaptics, EverySignal) { every_signal(); }
TEST_F(OpenHaptics, EveryTrueCrash) {
  every_true_crash();
  true_crash(StrangerBus::servo_in_frame, SIGSEGV, "servo thread, in frame");
  true_crash(StrangerBus::servo_outside, SIGSEGV, "servo thread, outside");
  EXPECT_EQ(breaches(), "");
}
TEST_F(OpenHaptics, Killed) { killed(); }

TEST_F(OpenHaptics, AFrameThatHangsLeavesTheMotorsOff) {
  using Bus = StrangerBus;
  for (const int signal : {SIGTERM, SIGSEGV, SIGABRT}) {
    const std::string then = ", then signal " + std::to_string(signal);
    hangs_before(Bus::begin_hangs, signal, "hdBeginFrame" + then);
    hangs_before(Bus::end_hangs, signal, "hdEndFrame" + then);
    hangs_before(Bus::end_and_disable_hang, signal, "hdDisable, too" + then);
  }
  hangs_alone(Bus::begin_hangs, 100, "hdBeginFrame");
  EXPECT_EQ(breaches(), "");
}
TEST_F(OpenHaptics, AFrameThatHangsIsAFaultWithTheMotorsOff) {
  hangs_alone(StrangerBus::end_hangs, 100, "hdEndFrame");
}
TEST_F(OpenHaptics, ADisableThatHangsIsAFaultThatPromisesNothing) {
  hangs_alone(StrangerBus::end_and_disable_hang, 100, "hdDisable, too", false);
}
TEST_F(OpenHaptics, AFaultWithMotorsThatMayBeOnSaysSo) { nothing_works(3); }

class ForceDimension : public MotorsOff {
  std::string device() const override {
    return "driver = \"forcedimension\"\nlibrary = \"" STRANGER_DHD "\"\n";
  }
};
TEST_F(ForceDimension, EverySignal) { every_signal(); }
TEST_F(ForceDimension, EveryTrueCrash) { every_true_crash(); }
TEST_F(ForceDimension, Killed) { killed(); }

TEST_F(ForceDimension, AForceThatHangsLeavesTheMotorsOff) {
  for (const int signal : {SIGTERM, SIGSEGV}) {
    const std::string then = ", then signal " + std::to_string(signal);
    hangs_before(StrangerBus::end_hangs, signal, "dhdSetForceAndTorque" + then);
    hangs_before(StrangerBus::end_and_disable_hang, signal, "dhdEnableForce, too" + then);
  }
}

/// libdhd crashes in the hand's own thread with its lock held: nobody in that process can reach the device any more.
TEST_F(ForceDimension, CrashInTheVendorsLibrary) {
  for (const auto trouble : {StrangerBus::servo_in_frame, StrangerBus::servo_outside}) {
    ASSERT_TRUE(presses()) << log();
    const Outcome outcome = strike([&] { bus->trouble.store(trouble); }, 3);
    EXPECT_TRUE(WIFSIGNALED(outcome.status) && WTERMSIG(outcome.status) == SIGSEGV) << outcome.status;
    EXPECT_GE(outcome.off_ms, 0) << log();
    EXPECT_TRUE(outcome.stayed_off);
    std::printf("  off after %.2f ms, gone after %.1f ms\n", outcome.off_ms, outcome.gone_ms);
  }
}

/// A second crash, by the thread that switches off for the handler of the first signal: the driver is left alone, and the guardian
/// has its turn. Whichever signal ends the process.
TEST_F(OpenHaptics, ALibraryThatCrashesInTheHandlerDoesNotHoldUpTheEnd) {
  ASSERT_TRUE(presses()) << log();
  const Outcome outcome = strike(
      [this] {
        bus->trouble.store(StrangerBus::switch_crashes);
        std::this_thread::sleep_for(5ms);
        kill(haptic, SIGUSR1);
      },
      3);
  EXPECT_TRUE(WIFSIGNALED(outcome.status) &&
              (WTERMSIG(outcome.status) == SIGSEGV || WTERMSIG(outcome.status) == SIGUSR1))
      << outcome.status;
  EXPECT_GE(outcome.off_ms, 0) << "by the guardian\n" << log();
  EXPECT_TRUE(outcome.stayed_off);
}

/// A library that never comes back from the call that switches motors off.
TEST_F(OpenHaptics, ALibraryThatHangsDoesNotHoldUpTheEnd) {
  ASSERT_TRUE(presses()) << log();
  const Outcome outcome = strike(
      [this] {
        bus->trouble.store(StrangerBus::switch_hangs);
        std::this_thread::sleep_for(5ms);
        kill(haptic, SIGSEGV);
      },
      3);
  EXPECT_TRUE(WIFSIGNALED(outcome.status) && WTERMSIG(outcome.status) == SIGSEGV) << outcome.status;
  EXPECT_GE(outcome.off_ms, 0) << "by the guardian\n" << log();
  EXPECT_TRUE(outcome.stayed_off);
  std::printf("  off after %.2f ms, gone after %.1f ms\n", outcome.off_ms, outcome.gone_ms);
}

class Inverse3 : public MotorsOff {
  std::string device() const override { return "driver = \"inverse3\"\nservice_port = \"" + port + "\"\n"; }
  pid_t service_pid() const override { return service.pid(); }
  HelperProcess service{{"/usr/bin/python3", STRANGER_HAPLY, std::getenv(StrangerBus::variable)}};
  std::string port = service.line();
};
TEST_F(Inverse3, EverySignal) { every_signal(); }
TEST_F(Inverse3, Killed) { killed(); }

/// Nobody in a stopped process can lower a force, but the service listens to others, too.
TEST_F(Inverse3, Stopped) {
  ASSERT_TRUE(presses()) << log();
  kill(haptic, SIGSTOP);
  EXPECT_TRUE(until([this] { return bus->felt() == 0; })) << log();
  kill(haptic, SIGCONT);
  const Outcome outcome = strike([this] { kill(haptic, SIGTERM); });
  EXPECT_TRUE(WIFEXITED(outcome.status) && WEXITSTATUS(outcome.status) == 0) << outcome.status << "\n"
                                                                             << log();
}

}  // namespace
}  // namespace palpate::test
