#include "render_node/eye_pace.h"

#include <gtest/gtest.h>

namespace palpate::render {
namespace {

NodeStatus physics_at(double t, double real_time_factor) {
  NodeStatus status;
  status.phase = NodePhase::running;
  status.t = t;
  status.real_time_factor = real_time_factor;
  return status;
}

/// As many reports as make no difference any more.
void hear_often(EyePace& pace, double real_time_factor) {
  for (int n = 0; n < 100; ++n) pace.hear(physics_at(0.25 * n, real_time_factor));
}

TEST(EyePace, GivesWayToTissueThatFallsBehindAndComesBack) {
  EyePace pace(true);
  EXPECT_NEAR(pace.rest_s(0.01) + 0.01, EyePace::first_s, 1e-12);
  hear_often(pace, 0.8);
  EXPECT_NEAR(pace.rest_s(0.01) + 0.01, EyePace::longest_s, 1e-12);
  hear_often(pace, 1.0);
  EXPECT_NEAR(pace.rest_s(0.005) + 0.005, EyePace::shortest_s, 1e-12);
  pace.hear(physics_at(1, 0.9));
  EXPECT_NEAR(pace.rest_s(0.005) + 0.005, 1.25 * EyePace::shortest_s, 1e-12) << "at once";
}

TEST(EyePace, LeavesHalfOfTheTimeToOthersWhereTheProcessorDraws) {
  EyePace pace(true);
  hear_often(pace, 1.0);
  EXPECT_DOUBLE_EQ(pace.rest_s(0.03), 0.03);
  EXPECT_DOUBLE_EQ(pace.rest_s(2.0), 0.1);
  EyePace card(false);
  hear_often(card, 0.5);
  EXPECT_NEAR(card.rest_s(0.01) + 0.01, EyePace::shortest_s, 1e-12);
  EXPECT_DOUBLE_EQ(card.rest_s(0.03), 0.0);
}

TEST(EyePace, HearsEachReportOnceAndNoneOfAWorldThatStands) {
  EyePace pace(true), other(true);
  pace.hear(physics_at(1, 0.5));
  other = pace;
  for (int n = 0; n < 50; ++n) other.hear(physics_at(1, 0.5));
  EXPECT_EQ(pace.rest_s(0.01), other.rest_s(0.01));
  NodeStatus loading = physics_at(2, 0);
  loading.phase = NodePhase::loading;
  other.hear(loading);
  EXPECT_EQ(pace.rest_s(0.01), other.rest_s(0.01));
}

}  // namespace
}  // namespace palpate::render
