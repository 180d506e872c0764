// Patches lost on the way, by the loss that DDS itself can inject: counted rightly, and no fault.
// PALPATE_LOSS_SECONDS in the environment: how long each is measured.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "common/wire/loopback_config.h"
#include "tests/system/hand_session.h"

namespace palpate::test {
namespace {

class HandLoss : public HandSession, public testing::WithParamInterface<int> {};

TEST_P(HandLoss, IsCountedAndIsNoFault) {
  // 1. the programs, not the test, lose GetParam() of 1000 packets that they send
  std::string config(loopback_config());
  const std::string_view end_of_domain = "  </Domain>";
  config.insert(config.find(end_of_domain), "<Internal><Test><XmitLossiness>" + std::to_string(GetParam()) +
                                                "</XmitLossiness></Test></Internal>\n");
  std::ofstream(folder / "lossy.xml") << config;
  setenv("CYCLONEDDS_URI", ("file://" + (folder / "lossy.xml").string()).c_str(), 1);
  haptic = start(PALPATE_HAPTIC);
  std::this_thread::sleep_for(500ms);
  start_physics();
  unsetenv("CYCLONEDDS_URI");

  // 2. contact for a while, then physics says how many patches it has sent; statuses are reliable
  Participant participant(domain);
  Reader<NodeStatus> statuses(participant);
  Reader<ContactPatch> patches(participant);
  NodeStatus hand, tissue;
  // What was sent before the two had found each other, which takes a second more where an announcement is lost, was nobody's
  // to count. So both counts begin at a status of the hand in contact, and what physics had sent by then is read from the numbers and
  // stamps of patches: a status itself may have been lost once, and have come late.
  std::vector<std::pair<std::int64_t, std::uint64_t>> sent_at;            // stamp and number of patches
  std::int64_t hand_start_ns = std::numeric_limits<std::int64_t>::max();  // when its t was 0
  double received_before = 0, lost_before = 0, t_before = 0;
  bool in_contact = false, begun = false;
  const auto listen = [&] {
    ContactPatch patch;
    while (patches.take(patch)) sent_at.emplace_back(patch.stamp_ns, patch.tick);
    NodeStatus status;
    while (statuses.take(status)) {
      if (status.node != NodeKind::haptic) {
        tissue = status;
        continue;
      }
      hand = status;
      hand_start_ns = std::min(hand_start_ns, now_ns() - ns_from_seconds(hand.t));
      if (!in_contact || begun || sent_at.size() < 50) continue;
      t_before = hand.t;
      received_before = static_cast<double>(hand.samples_received);
      lost_before = static_cast<double>(hand.samples_lost);
      begun = true;
    }
  };
  ASSERT_TRUE(presses()) << log();
  listen();
  in_contact = true;
  const char* given = std::getenv("PALPATE_LOSS_SECONDS");
  const double seconds = given != nullptr ? std::atof(given) : 6;
  for (const std::int64_t begin_ns = now_ns(); seconds_from_ns(now_ns() - begin_ns) < seconds; listen())
    statuses.wait(5ms);
  ASSERT_TRUE(begun) << log();
  const std::uint32_t stale = hand.stale_events;
  end(physics, SIGTERM);
  const std::int64_t ended_ns = now_ns();
  while (seconds_from_ns(now_ns() - ended_ns) < 0.6) statuses.wait(50ms), listen();
  ASSERT_EQ(tissue.phase, NodePhase::stopping);
  const std::int64_t begun_ns = hand_start_ns + ns_from_seconds(t_before);
  std::uint64_t sent_before = 0;
  for (const auto& [stamp_ns, number] : sent_at)
    if (stamp_ns <= begun_ns) sent_before = std::max(sent_before, number);
  ASSERT_GT(sent_before, 0u) << log();

  // 3. one tool: a patch a frame
  const double sent = static_cast<double>(tissue.ticks - sent_before);
  const double truth = sent - (static_cast<double>(hand.samples_received) - received_before);
  const double counted = static_cast<double>(hand.samples_lost) - lost_before;
  std::printf(
      "%d of 1000 packets lost on purpose: of %.0f patches %.0f did not come (%.1f %%), %.0f counted; %u "
      "stale, %u "
      "safe, %u faults\n",
      GetParam(), sent, truth, 100 * truth / sent, counted, stale, hand.safe_events, hand.faults);
  EXPECT_GT(truth, 0.2e-3 * GetParam() * sent) << "the loss is there";
  // The last ones may not have come, and which patch a status was after is known to one or two.
  EXPECT_NEAR(counted, truth, 0.05 * truth + 4);
  EXPECT_EQ(hand.faults, 0u);
  expect_no_kick();
}

INSTANTIATE_TEST_SUITE_P(PerMille, HandLoss, testing::Values(10, 100));

}  // namespace
}  // namespace palpate::test
