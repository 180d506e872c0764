// Sessions over two network namespaces, laid out by deploy/two_host_lab.sh.

#include "tests/system/two_pcs.h"

#include <gmock/gmock.h>

#include <random>

namespace palpate::test {
namespace {

using testing::HasSubstr;
using testing::Not;

void expect_a_felt_press(const nlohmann::json& hand, const nlohmann::json& tissue,
                         const nlohmann::json& eye) {
  EXPECT_GT(hand["haptic"]["patches"].get<int>(), 500);
  EXPECT_GT(hand["haptic"]["loop_age_ms"]["p50"].get<double>(), 0.0);
  EXPECT_LE(hand["haptic"]["energy_max_J"].get<double>(), 1e-4) << "the wire makes no energy";
  EXPECT_EQ(hand["haptic"]["faults"], 0);
  EXPECT_GT(tissue["tools"]["tip"]["force_peak"].get<double>(), 0.1);
  EXPECT_GT(eye["render"]["frames"].get<int>(), 5);
  EXPECT_EQ(eye["render"]["facets_visible"], 1600);
}

TEST_F(TwoPcs, RenderHereFeelThere) {
  ASSERT_EQ(lab(fmt::format("run p2 {} --seconds 3", quoted(SCENES "/box_press.toml"))), 0) << text("said");
  expect_a_felt_press(summary("pc2"), summary("pc2"), summary("pc1"));
  EXPECT_FALSE(summary("pc1")["nodes"].contains("haptic")) << "each side tells of its own nodes";
  EXPECT_THAT(text("out/pc1.txt"), HasSubstr("palpate: haptic is there, on "));
}

TEST_F(TwoPcs, DeformHereFeelThereOverABadCable) {
  ASSERT_EQ(lab(fmt::format("run p3 {} --seconds 3 --delay 5 --jitter 5 --loss 10",
                            quoted(SCENES "/box_press.toml"))),
            0)
      << text("said");
  expect_a_felt_press(summary("pc2"), summary("pc1"), summary("pc1"));
  EXPECT_GE(summary("pc2")["haptic"]["loop_age_ms"]["p50"].get<double>(), 10.0) << "5 ms each way";
}

TEST_F(TwoPcs, RefuseAnotherSceneInWords) {
  const std::string first =
      palpate("box_press", "--nodes physics --peers 192.168.77.2 --seconds 1 --out " + quoted(folder / "a"));
  const std::string second =
      palpate("inclusion", "--nodes haptic --peers 192.168.77.1 --seconds 1 --out " + quoted(folder / "b"));
  EXPECT_NE(
      lab(fmt::format("try {} {}", quoted("timeout 7 " + first + "; true"), quoted("sleep 3; " + second))),
      0);
  EXPECT_THAT(text("said"), HasSubstr("runs the scene box_press, this PC inclusion"));
  EXPECT_THAT(text("said"), Not(HasSubstr("this PC box_press"))) << "who was there first stays";
  EXPECT_FALSE(fs::exists(folder / "b" / "summary.json"));
}

TEST_F(TwoPcs, RefuseANodeThatIsThereAlready) {
  const std::string first = palpate(
      "box_press", "--nodes physics,haptic --peers 192.168.77.2 --seconds 1 --out " + quoted(folder / "a"));
  const std::string second = palpate(
      "box_press", "--nodes haptic,render --peers 192.168.77.1 --seconds 1 --out " + quoted(folder / "b"));
  EXPECT_NE(
      lab(fmt::format("try {} {}", quoted("timeout 7 " + first + "; true"), quoted("sleep 3; " + second))),
      0);
  EXPECT_THAT(text("said"), HasSubstr("haptic is in this session already"));
}

// Without --peers the PCs behind one interface find each other.
TEST_F(TwoPcs, FindEachOtherByMulticast) {
  const std::string first =
      palpate("box_press", "--nodes physics --interface eth0 --seconds 2 --out " + quoted(folder / "a"));
  const std::string second = palpate(
      "box_press", "--nodes haptic,render --interface eth0 --seconds 2 --out " + quoted(folder / "b"));
  ASSERT_EQ(lab(fmt::format("try {} {}", quoted(first), quoted(second))), 0) << text("said");
  EXPECT_THAT(text("said"), HasSubstr("physics is there, on "));
  EXPECT_GT(read_json((folder / "b" / "summary.json").string())["haptic"]["patches"].get<int>(), 100);
}

// PC 1 has named a third machine as its peer; PC 2 knocks all the same.
TEST_F(TwoPcs, ASecondMachineIsNotHeardUnlessNamed) {
  const std::string first =
      palpate("box_press", "--nodes physics,render --peers 192.168.77.9 --out " + quoted(folder / "a"));
  const std::string second =
      palpate("box_press", "--nodes haptic --peers 192.168.77.1 --out " + quoted(folder / "b"));
  lab(fmt::format("try {} {}", quoted("timeout 6 " + first + "; true"),
                  quoted("timeout 6 " + second + "; true")));
  EXPECT_THAT(text("said"), HasSubstr("haptic awaited"));
  EXPECT_THAT(text("said"), Not(HasSubstr("is there")));
}

TEST_F(TwoPcs, AloneASessionListensToItsOwnMachineOnly) {
  const std::string session = palpate("box_press", "--seconds 3 --out " + quoted(folder / "a"));
  const std::string list =
      "sleep 1.5; ss --no-header --udp --listening --numeric >" + quoted(folder / "sockets");
  ASSERT_EQ(lab(fmt::format("try {} true", quoted(fmt::format("({}) & {}; wait", list, session)))), 0)
      << text("said");
  std::ifstream sockets(folder / "sockets");
  int n = 0;
  for (std::string line; std::getline(sockets, line); ++n)
    EXPECT_THAT(line, testing::AnyOf(HasSubstr("%lo:"), HasSubstr(" 127."))) << "heard beyond this machine";
  EXPECT_GE(n, 8) << "two of each node and of the supervisor";
}

// 3,000 datagrams here; the same program threw 100,000 by hand.
TEST_F(TwoPcs, MalformedDatagramsCrashNobody) {
  const unsigned seed = std::random_device()();
  const std::string session = palpate("box_press", "--domain 3 --seconds 4 --out " + quoted(folder / "a"));
  const std::string storm =
      fmt::format("sleep 2; {} 3 3000 {} >{}", quoted(STORM), seed, quoted(folder / "storm"));
  ASSERT_EQ(lab(fmt::format("try {} true",
                            quoted(fmt::format("({}) & {}; code=$?; wait; exit $code", storm, session)))),
            0)
      << text("said") << "seed " << seed;
  EXPECT_THAT(text("storm"), HasSubstr("sent 3000")) << "seed " << seed;
  const auto summary = read_json((folder / "a" / "summary.json").string());
  for (const char* node : {"physics", "haptic", "render"})
    EXPECT_EQ(summary["nodes"][node]["exit_code"], 0) << node << " seed " << seed;
}

}  // namespace
}  // namespace palpate::test
