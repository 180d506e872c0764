// The driver printed in docs/device.md is built from there, loaded, and held in a hand.

#include <gtest/gtest.h>

#include "common/error/error.h"
#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

Scene template_scene() {
  Scene scene = scene_with(HandModel::arm, {});
  setenv("PALPATE_DRIVERS", PALPATE_BROKEN_DRIVERS, 1);
  scene.devices[0].driver = "template";
  scene.devices[0].offset = {0.01, 0.02, 0.03};
  return scene;
}

TEST(TemplateDriver, RunsAsTheDocumentationPromises) {
  VirtualWorld world(template_scene());
  world.run(0.1, 150);
  EXPECT_EQ(world.session.state(), HapticState::run);
  EXPECT_STREQ(world.session.device_info().model, "template");
  EXPECT_NEAR(world.z(), 0.03, 1e-15);
  EXPECT_NEAR(world.session.controller().force_limit(), 0.88, 1e-15);
  world.session.begin_stop();
  world.run(0.05, 150);
  EXPECT_TRUE(world.session.stopped());
}

TEST(TemplateDriver, SaysThatItTakesNoOptions) {
  Scene scene = template_scene();
  scene.devices[0].options = {{"cable", "usb3"}};
  EXPECT_THROW(VirtualWorld world(scene), InputError);
}

}  // namespace
}  // namespace palpate::haptic::test
