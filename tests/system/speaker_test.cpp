// Who is heard on a topic that one process speaks on: processes of a session that say who they are, and some that do not.

#include "common/wire/speaker.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "common/wire/reader.h"
#include "common/wire/writer.h"
#include "tests/system/dds_domain.h"

namespace palpate::test {
namespace {

using namespace std::chrono_literals;

/// A process that has not ended on any machine: the hand, on pc1 as this one, looks.
constexpr std::uint32_t first_of_all = 1;

Identity somebody(const std::string& role, const std::string& host, std::uint32_t pid) {
  Identity identity = own_identity(role, "block.toml", 7);
  identity.host = host;
  identity.pid = pid;
  return identity;
}

Membership member(const Identity& identity) {
  Membership membership;
  membership.domain = own_domain();
  membership.identity = identity;
  return membership;
}

/// A process that writes patches.
class Voice {
 public:
  explicit Voice(const Identity& identity) : participant_(member(identity)), writer_(participant_) {}
  void say(std::uint64_t tick) {
    ContactPatch patch;
    patch.tick = tick;
    ASSERT_TRUE(writer_.write(patch));
  }
  bool is_known() { return writer_.matched() > 0; }

 private:
  Participant participant_;
  Writer<ContactPatch> writer_;
};

class OneSpeaker : public testing::Test {
 protected:
  static constexpr auto patience = 300ms;
  /// Says it until a patch has come, 10 s at most. @return its tick; 0: none came
  std::uint64_t heard(Voice& voice, std::uint64_t tick, std::chrono::milliseconds within = 10s) {
    ContactPatch patch;
    for (const auto end = std::chrono::steady_clock::now() + within;
         std::chrono::steady_clock::now() < end;) {
      voice.say(tick);
      std::this_thread::sleep_for(2ms);
      while (reader.take(patch))
        if (patch.tick == tick) return tick;
    }
    return 0;
  }
  /// Not in fifty times of which a voice that may speak is heard each. @param speaking  says 0 meanwhile, so that it is never silent
  bool stays_unheard(Voice& voice, std::uint64_t tick, Voice* speaking) {
    ContactPatch patch;
    for (int times = 0; times < 50;) {
      if (speaking != nullptr) speaking->say(0);
      if (voice.is_known()) voice.say(tick), ++times;
      std::this_thread::sleep_for(2ms);
      while (reader.take(patch))
        if (patch.tick == tick) return false;
    }
    return true;
  }
  std::string remarks() {
    std::string all;
    for (const auto& line : speaker.remarks()) all += line + "\n";
    return all;
  }

  Identity hand = somebody("haptic", "pc1", 99);
  Participant participant{member(hand)};
  Speaker speaker{participant, "physics", patience};
  Reader<ContactPatch> reader{participant, &speaker};
};

TEST_F(OneSpeaker, KeepsItsPlaceWhileItSpeaks) {
  Voice first(somebody("physics", "pc1", first_of_all)), second(somebody("physics", "pc2", 20)),
      unnamed(Identity{});
  ASSERT_EQ(heard(first, 1), 1U);
  EXPECT_TRUE(stays_unheard(second, ~0ULL - 1, &first));
  ASSERT_EQ(heard(first, 2), 2U);
  EXPECT_TRUE(stays_unheard(unnamed, ~0ULL, &first));
  ASSERT_EQ(heard(first, 3), 3U);
  EXPECT_EQ(speaker.changes(), 1U);
  EXPECT_GE(reader.counts().foreign, 2U);
  EXPECT_EQ(reader.counts().rejected, (std::array<std::uint64_t, n_tallies>{}));
  EXPECT_STREQ(reader.counts().first_refused.data(),
               "ContactPatch of physics on pc2 (pid 20) is not heard: physics on pc1 (pid 1) speaks here");
  const std::string said = remarks();
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2) << "a line each\n" << said;
  EXPECT_NE(said.find("a process that does not say who it is"), std::string::npos) << said;
}

/// DDS keeps the newest sample of a tool: what a stranger sends must not take the place of what was not read yet.
TEST_F(OneSpeaker, IsHeardAmongManyMoreOfOthers) {
  Voice physics(somebody("physics", "pc1", first_of_all)), stranger(Identity{});
  ASSERT_EQ(heard(physics, 1), 1U);
  ASSERT_TRUE(stays_unheard(stranger, ~0ULL, &physics));
  ContactPatch patch;
  int heard_ones = 0;
  for (std::uint64_t tick = 2; tick < 202; ++tick) {
    physics.say(tick);
    for (int i = 0; i < 20; ++i) stranger.say(1'000'000 + tick);
    heard_ones += reader.take(patch) && patch.tick == tick;
  }
  EXPECT_GE(heard_ones, 190) << "one that came after a pause of this machine may be looked at";
  EXPECT_GE(reader.counts().foreign, 190U * 20U);
}

TEST_F(OneSpeaker, HasAnHeirWhenItIsSilent) {
  Voice first(somebody("physics", "pc1", first_of_all)), second(somebody("physics", "pc2", 20));
  ASSERT_EQ(heard(first, 1), 1U);
  ASSERT_EQ(heard(second, 2), 2U);
  EXPECT_EQ(speaker.changes(), 2U);
  EXPECT_TRUE(stays_unheard(first, 3, &second)) << "the place is taken";
  EXPECT_NE(remarks().find("physics on pc2 (pid 20) speaks as physics from now on"), std::string::npos);
}

TEST_F(OneSpeaker, HasAnHeirAtOnceWhenItsProcessHasEnded) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  Voice ended(somebody("physics", hand.host, static_cast<std::uint32_t>(child)));
  Voice heir(somebody("physics", hand.host, static_cast<std::uint32_t>(getpid())));
  ASSERT_EQ(heard(ended, 1), 1U);
  while (!heir.is_known()) std::this_thread::sleep_for(1ms);
  ASSERT_EQ(heard(ended, 2), 2U) << "it spoke a moment ago";
  EXPECT_EQ(heard(heir, 3, patience / 2), 3U);
}

TEST_F(OneSpeaker, GivesWayToOneThatSaysWhoItIs) {
  Voice unnamed(Identity{}), physics(somebody("physics", "pc1", first_of_all));
  ASSERT_EQ(heard(unnamed, 1), 1U) << "a tool or a test, where there is no physics";
  EXPECT_EQ(heard(physics, 2, patience / 2), 2U);
  EXPECT_TRUE(stays_unheard(unnamed, 3, &physics));
}

TEST_F(OneSpeaker, IsOfThisSceneAndOfItsRole) {
  Identity elsewhere = somebody("physics", "pc2", 30);
  elsewhere.checksum = 8;
  Voice other_scene(elsewhere), other_role(somebody("haptic", "pc2", 40));
  EXPECT_TRUE(stays_unheard(other_scene, 1, nullptr)) << "although nobody else speaks";
  EXPECT_TRUE(stays_unheard(other_role, 2, nullptr));
  EXPECT_EQ(speaker.changes(), 0U);
  const std::string said = remarks();
  EXPECT_NE(said.find("another text of the scene"), std::string::npos) << said;
  EXPECT_NE(said.find("only physics may speak here"), std::string::npos) << said;
}

TEST(ManySpeakers, AreHeardIfTheirRoleIsAmongThose) {
  Participant participant(member(somebody("physics", "pc1", 1)));
  Speaker people(participant, {"render", "supervisor"});
  Reader<Command> reader(participant, &people);
  const auto commands = [&](const Identity& identity) {
    Participant other(member(identity));
    Writer<Command> writer(other);
    while (writer.matched() == 0) std::this_thread::sleep_for(1ms);
    Command command;
    for (int i = 0; i < 25; ++i) {
      if (!writer.write(command)) return false;
      std::this_thread::sleep_for(2ms);
      if (reader.take(command)) return true;
    }
    return false;
  };
  EXPECT_TRUE(commands(somebody("render", "pc1", 2)));
  EXPECT_TRUE(commands(somebody("supervisor", "pc2", 3)));
  EXPECT_TRUE(commands(Identity{})) << "palpate reset, scripts";
  EXPECT_FALSE(commands(somebody("haptic", "pc1", 4)));
  EXPECT_GE(reader.counts().foreign, 1U);
}

}  // namespace
}  // namespace palpate::test
