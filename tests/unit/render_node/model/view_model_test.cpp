#include "render_node/model/view_model.h"

#include <gtest/gtest.h>

#include "common/scene/scene.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

const auto cube = test::cube_surface(8, 0.1, 0xffffffffU);

TEST(ViewModel, CountsWhatIsAboutNothingKnown) {
  ViewModel model(test::small_scene());
  auto chunk = test::chunks_of(cube, 1, 1)[0];  // the scene has body 0 only
  model.take(chunk);
  auto trace = test::trace_at({0, 0, 0}, 0, 1);
  trace.tool = 1;
  model.take(trace);
  ToolWrench wrench;
  wrench.tool = 9;
  model.take(wrench);
  model.take(test::block_of(cube, 1, 1, 0));
  SurfaceChange page;
  page.body = 1;
  model.take(page);
  EXPECT_EQ(model.samples_ignored(), 5U);
  EXPECT_FALSE(model.anything_to_see());
}

TEST(ViewModel, LearnsOfAToolFromTraceAndWrench) {
  ViewModel model(test::small_scene());
  EXPECT_FALSE(model.tools()[0].tip.has_value());
  model.take(test::trace_at({0.01, 0.02, 0.03}, 1.5, 2.5));
  ToolWrench wrench;
  wrench.t = 1.25;
  wrench.force = {3, 0, 4};
  wrench.n_contacts = 17;
  model.take(wrench);
  const ToolView& tool = model.tools()[0];
  EXPECT_EQ(*tool.tip, Vec3(0.01, 0.02, 0.03));
  EXPECT_DOUBLE_EQ(tool.on_hand.now(), 2.5);
  EXPECT_TRUE(tool.answered);
  EXPECT_DOUBLE_EQ(tool.force.norm(), 5.0);
  EXPECT_TRUE(tool.on_tool.empty()) << "it answers no hand";
  EXPECT_EQ(tool.n_contacts, 17U);
  EXPECT_DOUBLE_EQ(model.t(), 1.25);  // simulated time, not the device's
}

TEST(ViewModel, KeepsTheFirstBoxWhenABodyShrinks) {
  ViewModel model(test::small_scene());
  for (const auto& chunk : test::chunks_of(cube, 0, 1)) model.take(chunk);
  EXPECT_NEAR(model.box().max().x(), 0.05, 1e-6);
  for (const auto& chunk : test::chunks_of(test::cube_surface(8, 0.02, 0xffffffffU), 0, 2)) model.take(chunk);
  EXPECT_EQ(model.bodies()[0].surface().revision, 2U);
  EXPECT_NEAR(model.box().max().x(), 0.05, 1e-6);
}

TEST(ViewModel, KeepsTheNewestStatusOfEachNode) {
  ViewModel model(test::small_scene());
  NodeStatus status;
  status.node = NodeKind::haptic;
  status.rate_Hz = 999;
  model.take(status);
  status.rate_Hz = 1001;
  model.take(status);
  EXPECT_FALSE(model.node(NodeKind::physics).has_value());
  EXPECT_EQ(model.node(NodeKind::haptic)->rate_Hz, 1001);
}

}  // namespace
}  // namespace palpate::render
