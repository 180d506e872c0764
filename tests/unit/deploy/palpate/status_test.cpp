#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "deploy/palpate/status_board.h"
#include "deploy/palpate/status_line.h"

namespace palpate::deploy {
namespace {

NodeStatus status_of(NodeKind node, NodePhase phase, std::uint32_t pid) {
  NodeStatus status;
  status.node = node;
  status.phase = phase;
  status.pid = pid;
  return status;
}

TEST(StatusBoard, KnowsOnlyTheProcessesThatWereStarted) {
  StatusBoard board;
  board.expect(NodeKind::physics, 12);
  board.note(status_of(NodeKind::physics, NodePhase::running, 99));
  board.note(status_of(NodeKind::haptic, NodePhase::running, 13));
  EXPECT_FALSE(board.at(NodeKind::physics).newest);
  EXPECT_FALSE(board.at(NodeKind::haptic).newest);
  board.note(status_of(NodeKind::physics, NodePhase::ready, 12));
  EXPECT_TRUE(board.at(NodeKind::physics).newest);
  EXPECT_FALSE(board.at(NodeKind::physics).running());
}

TEST(StatusBoard, TakesMeansOverWholePeriodsOfTheRunningPhaseOnly) {
  StatusBoard board;
  board.expect(NodeKind::physics, 12);
  auto status = status_of(NodeKind::physics, NodePhase::loading, 12);
  status.rate_Hz = 5;
  board.note(status);
  status.phase = NodePhase::running;
  for (const double rate : {300.0, 900.0, 1100.0}) {
    status.rate_Hz = rate;
    status.real_time_factor = rate / 1000;
    board.note(status);
  }
  EXPECT_DOUBLE_EQ(board.at(NodeKind::physics).mean_rate_Hz(), 1000);
  EXPECT_DOUBLE_EQ(board.at(NodeKind::physics).mean_real_time_factor(), 1);
  EXPECT_DOUBLE_EQ(board.at(NodeKind::render).mean_rate_Hz(), 0);
}

TEST(StatusText, SaysWhatEachNodeDoes) {
  StatusBoard board;
  board.expect(NodeKind::physics, 1);
  board.expect(NodeKind::haptic, 2);
  board.expect(NodeKind::render, 3);
  auto physics = status_of(NodeKind::physics, NodePhase::running, 1);
  physics.rate_Hz = 999.6;
  physics.real_time_factor = 0.984;
  physics.warnings = 2;
  const std::string trouble = "the guard brought the last good state back 1 time(s)";
  std::copy(trouble.begin(), trouble.end(), physics.note.begin());
  auto haptic = status_of(NodeKind::haptic, NodePhase::running, 2);
  haptic.rate_Hz = 1000;
  haptic.loop_age_ms_p50 = 1.23;
  board.note(physics);
  board.note(haptic);
  const std::vector<NodeKind> nodes = {NodeKind::physics, NodeKind::haptic, NodeKind::render};
  EXPECT_EQ(status_text(board, nodes, 12.34),
            "  12.3 s | physics 1000 Hz x0.98 | haptic 1000 Hz loop 1.2 ms | render starting | "
            "the guard brought the last good state back 1 time(s)");
  auto silent = haptic;
  silent.warnings = 4;
  silent.stale_events = 1;
  silent.safe_events = 3;
  board.note(silent);
  EXPECT_EQ(status_text(board, {NodeKind::haptic}, 0),
            "   0.0 s | haptic 1000 Hz loop 1.2 ms | physics was silent for the hand, no force was sent to "
            "the hand (3 times)");
  EXPECT_EQ(cut_to("physics was silent", 11), "physics ...");
  EXPECT_EQ(cut_to("physics", 7), "physics");
  EXPECT_EQ(cut_to("physics", 0), "physics");
  haptic.surplus_J = 0.234e-3;
  board.note(haptic);
  EXPECT_EQ(status_text(board, {NodeKind::haptic}, 0),
            "   0.0 s | haptic 1000 Hz loop 1.2 ms, NOT PASSIVE 0.23 mJ");
  haptic.phase = NodePhase::ready;
  const std::string note = "rt: fifo=no mlock=no; tip: ready (inside the tissue, move out)";
  std::copy(note.begin(), note.end(), haptic.note.begin());
  board.note(haptic);
  EXPECT_EQ(status_text(board, {NodeKind::haptic}, 0),
            "   0.0 s | haptic ready (tip: ready (inside the tissue, move out))");
  board.note(status_of(NodeKind::render, NodePhase::loading, 3));
  EXPECT_EQ(status_text(board, {NodeKind::render}, 0), "   0.0 s | render loading");
}

}  // namespace
}  // namespace palpate::deploy
