#include "render_node/model/inside_control.h"

#include <gtest/gtest.h>

#include "common/scene/body_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"

namespace palpate::render {
namespace {

Scene head(double keep_min = -300, double keep_max = 3000) {
  Scene scene;
  BodySpec body;
  body.lattice = LatticeKind::voxel;
  VolumeShape image;
  image.keep_min = keep_min;
  image.keep_max = keep_max;
  body.shape = image;
  scene.bodies.push_back(body);
  return scene;
}

TEST(InsideControl, BeginsWithBoneAndMakesTheSkinAVeil) {
  InsideControl control(head());
  EXPECT_TRUE(control.applies());
  EXPECT_FALSE(control.value());
  EXPECT_EQ(control.opacity(), 1);
  control.toggle();
  EXPECT_EQ(control.value(), 300);
  EXPECT_EQ(control.opacity(), InsideControl::veil);
  control.toggle();
  EXPECT_FALSE(control.value());
  EXPECT_EQ(control.opacity(), 1);
}

TEST(InsideControl, KeepsAnOpacityThatWasChosen) {
  Scene scene = head();
  scene.render->opacity = 0.6;
  InsideControl control(scene);
  control.toggle();
  EXPECT_EQ(control.opacity(), 0.6);
  control.set_opacity(-3);
  EXPECT_EQ(control.opacity(), InsideControl::least_opacity);
}

TEST(InsideControl, BeginsWithTheBrighterHalfOfAnImageOfBytes) {
  InsideControl control(head(20, 255));
  control.toggle();
  EXPECT_EQ(control.value(), 127.5);
}

TEST(InsideControl, AppliesToImagesAlone) {
  Scene scene = head();
  scene.bodies[0].shape = BoxShape{};
  InsideControl control(scene);
  EXPECT_FALSE(control.applies());
  control.toggle();
  control.obey(300.0);
  EXPECT_FALSE(control.value());
  EXPECT_FALSE(control.due(1, true));
}

TEST(InsideControl, CommandsWhatIsNewAndNotWhatItWasTold) {
  InsideControl control(head());
  EXPECT_FALSE(control.due(0, false));
  control.toggle();
  EXPECT_TRUE(control.due(0, false));
  EXPECT_FALSE(control.due(1, false));
  control.set(400);
  EXPECT_FALSE(control.due(0.1, false)) << "too soon";
  EXPECT_TRUE(control.due(0.1, true)) << "let go";
  control.obey(500.0);
  EXPECT_FALSE(control.due(2, true));
  EXPECT_EQ(control.value(), 500);
  control.obey(std::nullopt);
  EXPECT_FALSE(control.value());
}

}  // namespace
}  // namespace palpate::render
