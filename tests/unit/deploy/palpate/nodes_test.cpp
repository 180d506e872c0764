#include "deploy/palpate/nodes.h"

#include <gtest/gtest.h>

#include "common/error/error.h"

namespace palpate::deploy {
namespace {

TEST(Nodes, AreReadFromAListOnceEach) {
  EXPECT_EQ(parse_nodes("render,haptic,render"), (std::vector<NodeKind>{NodeKind::render, NodeKind::haptic}));
  EXPECT_EQ(parse_nodes("physics"), std::vector<NodeKind>{NodeKind::physics});
}

TEST(Nodes, RefuseOtherWords) {
  EXPECT_THROW(parse_nodes(""), InputError);
  EXPECT_THROW(parse_nodes("Physics"), InputError);
  EXPECT_THROW(parse_nodes("supervisor"), InputError);
}

TEST(Share, FollowsThePapers) {
  using enum NodeKind;
  const auto here = [](const char* deployment, int side) {
    return parse_share(deployment, side, {}, true).here;
  };
  const auto there = [](const char* deployment, int side) {
    return parse_share(deployment, side, {}, true).elsewhere;
  };
  EXPECT_EQ(here("p2", 1), std::vector{render});
  EXPECT_EQ(there("p2", 1), (std::vector{physics, haptic}));
  EXPECT_EQ(here("p2", 2), there("p2", 1));
  EXPECT_EQ(here("p3", 2), std::vector{haptic});
  EXPECT_EQ(there("p3", 2), (std::vector{physics, render}));
  EXPECT_EQ(here("p3", 1), there("p3", 2));
}

TEST(Share, ExpectsNobodyElsewhereOnOnePc) {
  EXPECT_EQ(parse_share("all", 0, {}, false).here.size(), 3U);
  EXPECT_TRUE(parse_share("all", 0, {}, true).elsewhere.empty());
  EXPECT_TRUE(parse_share("all", 0, "haptic", false).elsewhere.empty()) << "a part of a session, for tests";
  EXPECT_EQ(parse_share("all", 0, "haptic", true).elsewhere,
            (std::vector{NodeKind::physics, NodeKind::render}));
}

TEST(Share, HasNoHandWithoutATool) {
  using enum NodeKind;
  EXPECT_EQ(without_hand(parse_share("all", 0, {}, false)).here, (std::vector{physics, render}));
  EXPECT_EQ(without_hand(parse_share("p2", 1, {}, true)).elsewhere, std::vector{physics});
  EXPECT_THROW(without_hand(parse_share("p3", 2, {}, true)), InputError);
}

TEST(Share, RefusesWhatContradictsItself) {
  EXPECT_THROW(parse_share("p2", 0, {}, true), InputError);
  EXPECT_THROW(parse_share("all", 1, {}, true), InputError);
  EXPECT_THROW(parse_share("p3", 1, "haptic", true), InputError);
  EXPECT_THROW(parse_share("all", 0, "", true), InputError);
}

TEST(Nodes, StopHapticFirst) { EXPECT_EQ(stop_order.front(), NodeKind::haptic); }

}  // namespace
}  // namespace palpate::deploy
