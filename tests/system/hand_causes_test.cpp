// Why a hand has no force any more, in words and once; and that palpate-haptic ends when it is told to, whatever its driver
// does. Real programs with the watched driver.

#include <gmock/gmock.h>

#include <cstring>

#include "common/report/json_file.h"
#include "tests/system/hand_session.h"

namespace palpate::test {
namespace {

using testing::HasSubstr;

class HandCauses : public HandSession {
 protected:
  bool status_is(const std::function<bool(const NodeStatus&)>& wanted) {
    return until([&] {
      NodeStatus status;
      while (statuses.take(status))
        if (status.node == NodeKind::haptic) newest = status;
      return newest.ticks > 0 && wanted(newest);
    });
  }
  bool note_says(const std::string& words) {
    return status_is([&](const NodeStatus& status) {
      return std::string(status.note.data()).find(words) != std::string::npos;
    });
  }
  void say_in_driver(const char* words) {
    std::strncpy(device->words.data(), words, device->words.size() - 1);
  }

  /// @return how it ended by itself after SIGTERM; 0x7f00 (exit code 127): it did not in 20 s
  int ended() {
    kill(haptic, SIGTERM);
    int status = 0x7f00;
    const pid_t pid = haptic;
    if (until([&] { return waitpid(pid, &status, WNOHANG) == pid; })) haptic = -1;
    return status;
  }
  void expect_failed_orderly(int status) {
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << std::hex << status << "\n" << log();
  }
  std::size_t times_in_log(const std::string& words) const {
    const std::string text = log();
    std::size_t n = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++n;
    return n;
  }
  nlohmann::json summary() const {
    return read_json((folder / "out" / "parts" / "haptic.json").string())["haptic"];
  }

  Participant participant{domain};
  Reader<NodeStatus> statuses{participant};
  NodeStatus newest;
};

struct Case {
  const char* name;
  void (*begin)(WatchedDevice&);
  const char* words;   // of the driver
  const char* says;    // in log and note
  const char* advice;  // likewise
  const char* cause;   // in the summary
};

TEST_F(HandCauses, EachIsSaidOnceWithTheDriversWordsAndWhatToDo) {
  const Case cases[] = {
      {"warm", [](WatchedDevice& watched) { watched.temperature = 1.0; }, "Warm motors (0x0200)",
       "its motors are too warm", "let it cool down", "overtemp"},
      {"cable", [](WatchedDevice& watched) { watched.unplugged = 1; }, "unplugged: USB",
       "unplugged, or nobody answers", "check cable and power", "lost"},
      {"button", [](WatchedDevice& watched) { watched.estop = 1; }, "", "its emergency button is pressed",
       "release the button", "emergency_stop"},
      {"nonsense", [](WatchedDevice& watched) { watched.nonsense = 1; }, "",
       "three impossible samples in a row", "check its sensors", "impossible"},
      {"off", [](WatchedDevice& watched) { watched.dropped = 1; }, "", "it switched its forces off by itself",
       "see its switch and light", "force_off"},
      {"blocked", [](WatchedDevice& watched) { watched.block_read_ms = 300; }, "",
       "its driver holds up the loop", "try another port", "blocked"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    std::filesystem::remove(folder / "log");
    start_both();
    ASSERT_TRUE(presses()) << log();
    say_in_driver(one.words);
    one.begin(*device);
    ASSERT_TRUE(note_says(one.says)) << newest.note.data() << log();
    EXPECT_THAT(std::string(newest.note.data()), HasSubstr(one.advice));
    EXPECT_EQ(newest.phase, NodePhase::failed);
    if (device->unplugged == 0) {  // else it must not be called any more
      EXPECT_EQ(device->powered, 0u);
    }
    expect_failed_orderly(ended());
    EXPECT_EQ(device->after_lost, 0u);
    EXPECT_EQ(times_in_log(one.says), 1u) << log();
    EXPECT_THAT(log(), HasSubstr("`palpate reset tip`"));
    EXPECT_THAT(log(), HasSubstr(one.words));
    const nlohmann::json causes = summary().value("fault_causes", nlohmann::json::array());
    ASSERT_EQ(causes.size(), 1u) << causes;
    EXPECT_EQ(causes[0]["cause"], one.cause);
    EXPECT_EQ(causes[0]["driver"], one.words);
    end(physics, SIGKILL);
    newest = {};
    new (&*device) WatchedDevice;
  }
}

TEST_F(HandCauses, AReadThatNeverComesBackShowsNoTicksIsNamedAndLeftBehind) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  device->hang_read = 1;
  EXPECT_TRUE(status_is([](const NodeStatus& status) { return status.rate_Hz == 0.0; })) << newest.rate_Hz;
  EXPECT_TRUE(note_says("its driver holds up the loop")) << newest.note.data();
  EXPECT_EQ(device->powered, 0u);
  expect_failed_orderly(ended());
  EXPECT_THAT(log(), HasSubstr("tip: its driver does not come back from a tick"));
  EXPECT_EQ(summary()["fault_causes"][0]["cause"], "blocked");
}

TEST_F(HandCauses, ACloseThatNeverComesBackIsLeftBehindWithMotorsOff) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  device->hang_close = 1;
  expect_failed_orderly(ended());
  EXPECT_EQ(device->powered, 0u);
  EXPECT_EQ(force_now(), 0.0);
  EXPECT_THAT(log(), HasSubstr("does not come back from closing its device"));
  EXPECT_GT(summary()["ticks"].get<int>(), 0);
}

TEST_F(HandCauses, MotorsThatNeverAnswerTheirSwitchDoNotKeepItFromEnding) {
  device->hang_enable = 1;
  start_both();
  ASSERT_TRUE(until([this] { return device->enabled == 1; })) << log();
  expect_failed_orderly(ended());
  EXPECT_THAT(log(), HasSubstr("tip: switching its motors"));
}

TEST_F(HandCauses, ADeviceThatNeverOpensDoesNotKeepItFromEnding) {
  device->hang_open = 1;
  haptic = start(PALPATE_HAPTIC);
  ASSERT_TRUE(until([this] { return device->opening > 0; }));
  expect_failed_orderly(ended());
  EXPECT_THAT(log(), HasSubstr("tip: opening its device"));
}

TEST_F(HandCauses, WarmMotorsAreSaidAndFeltBeforeTheirLimit) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  const double cold = force_now();
  device->temperature = 0.875;
  EXPECT_TRUE(note_says("motors at 88 % of their limit, 50 % of the force")) << newest.note.data();
  EXPECT_TRUE(until([&] { return force_now() < 0.6 * cold; })) << force_now() << " of " << cold;
  EXPECT_EQ(newest.faults, 0u);
  device->temperature = 0.96;
  EXPECT_TRUE(until([&] { return force_now() == 0.0; }));
  EXPECT_TRUE(until([&] { return times_in_log("no force, since its motors are at 96 %") == 1; })) << log();
  EXPECT_EQ(times_in_log("its motors are at 88 % of their limit; the force goes down"), 1u) << log();
  EXPECT_EQ(device->powered, 1u);
  expect_no_kick();
}

}  // namespace
}  // namespace palpate::test
