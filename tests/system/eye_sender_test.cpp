// What physics tells the eye: the newest of everything arrives, and what cannot be sent is told.

#include "physics_node/loop/eye_sender.h"

#include <gtest/gtest.h>

#include <chrono>

#include "common/wire/reader.h"
#include "tests/system/dds_domain.h"

namespace palpate::physics {
namespace {

using namespace std::chrono_literals;

template <class Done>
bool eventually(Done done) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

SurfaceChange page_of(std::uint32_t body, std::uint32_t page, std::uint32_t change) {
  SurfaceChange message;
  message.body = body;
  message.revision = 1;
  message.page = page;
  message.change = change;
  return message;
}

TEST(EyeSender, BringsTheNewestOfEachPage) {
  Participant participant(palpate::test::own_domain());
  Reader<SurfaceChange> reader(participant);
  EyeSender sender(participant, false);
  for (std::uint32_t change = 1; change <= 50; ++change)
    for (std::uint32_t page = 0; page < 4; ++page) sender.post(page_of(2, page, change));
  std::map<std::uint32_t, std::uint32_t> newest;
  SurfaceChange message;
  EXPECT_TRUE(eventually([&] {
    while (reader.take(message)) newest[message.page] = message.change;
    return newest == std::map<std::uint32_t, std::uint32_t>{{0, 50}, {1, 50}, {2, 50}, {3, 50}};
  }));
  EXPECT_TRUE(sender.take_incomplete().empty());
}

TEST(EyeSender, TellsOfABodyWhoseSurfaceItCouldNotSend) {
  Participant participant(palpate::test::own_domain());
  Reader<SurfaceChange> reader(participant);
  EyeSender sender(participant, false);
  SurfaceChange broken = page_of(3, 0, 1);
  broken.n_changes = max_change_facets + 1;  // no writer takes it
  sender.post(broken);
  sender.post(page_of(5, 0, 1));
  std::set<std::uint32_t> told;
  EXPECT_TRUE(eventually([&] {
    told.merge(sender.take_incomplete());
    return !told.empty();
  }));
  EXPECT_EQ(told, std::set<std::uint32_t>{3});
  EXPECT_TRUE(sender.take_incomplete().empty()) << "once";
  SurfaceChange message;
  EXPECT_TRUE(eventually([&] { return reader.take(message); })) << "all else goes on";
  EXPECT_EQ(message.body, 5u);
}

}  // namespace
}  // namespace palpate::physics
