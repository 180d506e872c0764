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

TEST(Nodes, StopHapticFirst) { EXPECT_EQ(stop_order.front(), NodeKind::haptic); }

}  // namespace
}  // namespace palpate::deploy
