// Shared memory through RouDi: used where it is fit, needed by nobody, and nothing stays behind. Skipped, with words, where
// iox-roudi is not installed or the kernel makes no namespaces for the one who runs the tests.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/report/json_file.h"
#include "tests/system/memory_room.h"

namespace palpate {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

constexpr const char* domain = "90";

class SharedMemory : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (std::system("command -v iox-roudi >/dev/null") != 0) {
      hindrance = "iox-roudi is not installed (package iceoryx)";
      return;
    }
    hindrance = test::enter_memory_room();
    if (hindrance.empty() && !std::filesystem::exists(PROBE))
      hindrance = "the build is not below the current folder, and /tmp is hidden";
  }
  void SetUp() override {
    if (!hindrance.empty()) GTEST_SKIP() << hindrance;
    unsetenv("PALPATE_SHARED_MEMORY");
  }

  std::unique_ptr<test::Process> roudi(const std::string& monitoring = "off") {
    auto process = std::make_unique<test::Process>(
        std::vector<std::string>{"iox-roudi", "-m", monitoring, "-c", ROUDI_TOML}, "/tmp/roudi.txt");
    EXPECT_TRUE(process->said("RouDi is ready")) << process->text();
    return process;
  }
  static void end(std::unique_ptr<test::Process>& roudi) {
    roudi->tell(SIGTERM);
    EXPECT_EQ(roudi->wait(), 0);
    roudi.reset();
    EXPECT_THAT(test::shared_files(), IsEmpty()) << "left in /dev/shm";
  }
  static std::unique_ptr<test::Process> probe(const std::string& what) {
    return std::make_unique<test::Process>(std::vector<std::string>{PROBE, what, domain},
                                           "/tmp/" + what + ".txt");
  }
  static std::unique_ptr<test::Process> session(const std::string& seconds) {
    return std::make_unique<test::Process>(
        std::vector<std::string>{PALPATE, "run", SCENE, "--headless", "--seconds", seconds, "--domain",
                                 domain, "--out", "/tmp/out"},
        "/tmp/session.txt");
  }
  static nlohmann::json summary() { return read_json("/tmp/out/summary.json"); }

  static inline std::string hindrance;
};

TEST_F(SharedMemory, IsNeededByNobody) {
  const auto echo = probe("echo");
  const auto talk = probe("talk");
  EXPECT_EQ(talk->wait(), 0);
  EXPECT_THAT(talk->text(), HasSubstr("shared=0"));
  EXPECT_THAT(talk->text(), HasSubstr("status=1 chunks=40"));
}

TEST_F(SharedMemory, LeavesAllElseToUdp) {
  auto daemon = roudi();
  const auto echo = probe("echo");
  const auto talk = probe("talk");
  EXPECT_EQ(talk->wait(), 0);
  EXPECT_EQ(echo->wait(), 0);
  EXPECT_THAT(talk->text(), HasSubstr("shared=1"));
  EXPECT_THAT(talk->text(), HasSubstr("status=1 chunks=40")) << "a late joiner gets every key";
  EXPECT_THAT(test::shared_files(), UnorderedElementsAre("iceoryx_mgmt", "root"))
      << "RouDi's own and no other";
  end(daemon);
}

TEST_F(SharedMemory, GivesTheNewestOfManyBlocksToASlowEyeWithoutTheNetwork) {
  auto daemon = roudi();
  const std::uint64_t before = test::loopback_bytes();
  const auto watch = probe("watch");
  const auto paint = probe("paint");
  EXPECT_EQ(paint->wait(), 0);
  EXPECT_EQ(watch->wait(), 0);
  EXPECT_THAT(paint->text(), HasSubstr("shared=1 refused=0"));
  EXPECT_THAT(watch->text(), HasSubstr("shared=1 newest=200"));
  EXPECT_THAT(watch->text(), Not(HasSubstr("TOO_MANY")));
  EXPECT_LT(test::loopback_bytes() - before, 20'000'000U) << "500 MB were written";
  end(daemon);
}

TEST_F(SharedMemory, IsNotTakenFromARouDiThatAbortsWhoStandsStill) {
  auto daemon = roudi("on");
  const auto echo = probe("echo");
  const auto talk = probe("talk");
  EXPECT_EQ(talk->wait(), 0);
  EXPECT_THAT(talk->text(), HasSubstr("shared=0"));
  test::Process doctor({PALPATE, "doctor"}, "/tmp/doctor.txt");
  doctor.wait();
  EXPECT_THAT(doctor.text(), HasSubstr("lacks  shared memory  RouDi runs, but it would abort a node"));
  EXPECT_THAT(doctor.text(), HasSubstr("--monitoring-mode off"));
  end(daemon);
}

TEST_F(SharedMemory, MayBeRefused) {
  auto daemon = roudi();
  setenv("PALPATE_SHARED_MEMORY", "off", 1);
  const auto echo = probe("echo");
  const auto talk = probe("talk");
  EXPECT_EQ(talk->wait(), 0);
  EXPECT_THAT(talk->text(), HasSubstr("shared=0"));
  EXPECT_EQ(echo->wait(), 0);
  end(daemon);
}

// The eye has begun before RouDi and hears over UDP, which may lose some of a burst; physics uses memory for whoever does.
TEST_F(SharedMemory, MayComeLater) {
  const auto watch = probe("watch");
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  auto daemon = roudi();
  const auto paint = probe("paint");
  EXPECT_EQ(paint->wait(), 0);
  EXPECT_EQ(watch->wait(), 0);
  EXPECT_THAT(paint->text(), HasSubstr("shared=1 refused=0"));
  EXPECT_THAT(watch->text(), HasSubstr("shared=0 newest="));
  EXPECT_THAT(watch->text(), Not(HasSubstr("newest=0")));
  end(daemon);
}

TEST_F(SharedMemory, CarriesASessionAndLeavesNothing) {
  auto daemon = roudi();
  const auto run = session("3");
  EXPECT_EQ(run->wait(), 0) << run->text();
  EXPECT_THAT(run->text(), HasSubstr("vertex blocks go through shared memory"));
  EXPECT_GT(summary()["haptic"]["patches"].get<int>(), 500);
  EXPECT_GT(summary()["render"]["frames"].get<int>(), 5);
  EXPECT_THAT(test::shared_files(), UnorderedElementsAre("iceoryx_mgmt", "root"));
  end(daemon);
}

TEST_F(SharedMemory, OutlivesRouDi) {
  auto daemon = roudi();
  const auto run = session("8");
  EXPECT_TRUE(run->said("vertex blocks go through shared memory"));
  EXPECT_TRUE(run->said("render [0-9]+ Hz")) << run->text();
  daemon->tell(SIGKILL);
  EXPECT_EQ(daemon->wait(), -SIGKILL);
  EXPECT_EQ(run->wait(), 0) << run->text();
  EXPECT_THAT(run->text(), HasSubstr("RouDi has gone"));
  EXPECT_GT(summary()["haptic"]["patches"].get<int>(), 1500);
  EXPECT_EQ(summary()["haptic"]["faults"], 0);
  const std::string text = run->text();
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_LT(lines, 60) << "three nodes complain once a second each at most\n" << text;
  daemon = roudi();  // clears up after the one before
  end(daemon);
}

TEST_F(SharedMemory, EndsInOrderWhenRouDiIsToldTo) {
  auto daemon = roudi();
  const auto run = session("60");
  EXPECT_TRUE(run->said("vertex blocks go through shared memory"));
  EXPECT_TRUE(run->said("render [0-9]+ Hz")) << run->text();
  end(daemon);
  EXPECT_EQ(run->wait(), 0) << run->text();
  EXPECT_THAT(run->text(), HasSubstr("RouDi was stopped, and has told the programs"));
  EXPECT_EQ(summary()["haptic"]["faults"], 0);
}

}  // namespace
}  // namespace palpate
