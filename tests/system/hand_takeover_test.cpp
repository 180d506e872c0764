// A hand that takes over from another, on a machine whose clock shows another time: physics goes by what it hears when.

#include "common/wire/writer.h"
#include "tests/system/hand_session.h"

namespace palpate::test {
namespace {

class HandTakeover : public HandSession, public testing::WithParamInterface<int> {
 protected:
  /// Speaks as a hand, at 1 kHz, until physics answers. @return whether it has
  bool is_answered(std::uint64_t first_tick, std::int64_t clock_ahead_ns) {
    Writer<ToolState> hand(participant);
    ToolState state;
    ContactPatch patch;
    state.p_WT = {0, 0, 0.03};
    state.tick = first_tick;
    return until([&] {
      state.tick += 1;
      state.stamp_ns = now_ns() + clock_ahead_ns;
      hand.write(state);
      while (patches.take(patch))
        if (patch.answers >= first_tick && patch.answers <= state.tick) return true;
      return false;
    });
  }

  Participant participant{domain};
  Reader<ContactPatch> patches{participant};
};

TEST_P(HandTakeover, IsAnsweredWhateverItsClockShows) {
  const std::int64_t ahead_ns = 1'000'000'000LL * GetParam();
  start_physics();
  ASSERT_TRUE(is_answered(5'000'000, 0)) << log();
  std::this_thread::sleep_for(100ms);
  EXPECT_TRUE(is_answered(1, ahead_ns)) << "a hand that has begun anew\n" << log();
}

INSTANTIATE_TEST_SUITE_P(SecondsAhead, HandTakeover, testing::Values(-3600, -5, 5));

}  // namespace
}  // namespace palpate::test
