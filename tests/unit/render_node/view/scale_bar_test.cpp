#include "render_node/view/scale_bar.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::render {
namespace {

TEST(ScaleBar, IsAsLongAsItSaysAtTheDepthOfTheTarget) {
  for (double distance = 1e-4; distance < 1e3; distance *= 1.37) {
    CameraSpec spec;
    spec.target = Vec3(0.1, 0.2, -0.1);
    spec.distance = distance;
    spec.yaw = 0.7;
    spec.pitch = 0.4;
    Camera camera(spec);
    camera.set_picture(1280, 720, 308);
    const ScaleBar bar = scale_bar(camera, 180);
    const Vec3 along = bar.metres * camera.axes().row(0).transpose();
    const auto a = camera.project(camera.target()), b = camera.project(camera.target() + along);
    ASSERT_TRUE(a && b);
    EXPECT_NEAR((*b - *a).norm(), bar.px, 1e-6 * bar.px);
    EXPECT_LE(bar.px, 180 * (1 + 1e-6));
    EXPECT_GE(bar.px, 180 / 2.5 - 1e-6) << "no shorter than the next round length allows";
    EXPECT_NEAR(std::stod(bar.words), bar.metres * 1e3, 1e-9 * bar.metres * 1e3);
    EXPECT_TRUE(bar.words.ends_with(" mm"));
  }
}

}  // namespace
}  // namespace palpate::render
