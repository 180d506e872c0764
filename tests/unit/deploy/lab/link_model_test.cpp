// The lab's cable in counted time.

#include "deploy/lab/link_model.h"

#include <gtest/gtest.h>

namespace palpate::lab {
namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr int n_frames = 20'000;

TEST(LinkModel, DelaysAllAndKeepsTheirOrder) {
  LinkModel link({.delay_ms = 5, .jitter_ms = 0, .loss_percent = 0}, 1);
  for (std::uint8_t i = 0; i < 100; ++i) link.take(i < 50 ? 0 : ms, i % 2, {i});
  EXPECT_FALSE(link.give(5 * ms - 1));
  EXPECT_EQ(link.next_due_ns(), 5 * ms);
  for (std::uint8_t i = 0; i < 100; ++i) {
    const auto frame = link.give(i < 50 ? 5 * ms : 6 * ms);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->bytes.front(), i);
    EXPECT_EQ(frame->to, i % 2);
  }
  EXPECT_FALSE(link.next_due_ns());
}

TEST(LinkModel, LosesWhatItIsTold) {
  LinkModel link({.delay_ms = 0, .jitter_ms = 0, .loss_percent = 10}, 3);
  for (int i = 0; i < n_frames; ++i) link.take(0, 0, {});
  const double expected = 0.1 * n_frames;
  const double sigma = std::sqrt(n_frames * 0.1 * 0.9);
  EXPECT_NEAR(static_cast<double>(link.lost()), expected, 5 * sigma);
  int given = 0;
  while (link.give(0)) ++given;
  EXPECT_EQ(given + static_cast<int>(link.lost()), n_frames);
}

TEST(LinkModel, SpreadsOverTheJitterAndReorders) {
  LinkModel link({.delay_ms = 20, .jitter_ms = 10, .loss_percent = 0}, 5);
  for (int i = 0; i < n_frames; ++i) link.take(0, 0, {static_cast<std::uint8_t>(i & 255)});
  std::int64_t first = 0, last = 0;
  int reordered = 0, before = -1;
  while (const auto due = link.next_due_ns()) {
    if (first == 0) first = *due;
    last = *due;
    const auto frame = link.give(*due);
    reordered += frame->bytes.front() < before ? 1 : 0;
    before = frame->bytes.front();
  }
  EXPECT_GE(first, 20 * ms);
  EXPECT_LE(last, 30 * ms);
  EXPECT_GT(last - first, 9 * ms);
  EXPECT_GT(reordered, n_frames / 4);
}

}  // namespace
}  // namespace palpate::lab
