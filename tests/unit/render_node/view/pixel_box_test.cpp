#include "render_node/view/pixel_box.h"

#include <gtest/gtest.h>

#include <random>

#include "render_node/view/camera.h"

namespace palpate::render {
namespace {

Lens lens_of(const Camera& camera, int width, int height) {
  return {(camera.projection() * camera.view()).cast<float>(), width, height};
}

TEST(PixelBox, HoldsEveryPointOfABoxInSpace) {
  CameraSpec spec;
  spec.yaw = 0.7;
  spec.pitch = 0.4;
  Camera camera(spec);
  camera.set_picture(640, 360, 100);
  camera.fit({Vec3::Constant(-0.1), Vec3::Constant(0.1)});
  const Lens lens = lens_of(camera, 640, 360);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> anywhere(-0.1F, 0.1F), share(0, 1);
  for (int n = 0; n < 300; ++n) {
    Eigen::AlignedBox3f box;
    for (int k = 0; k < 2; ++k)
      box.extend(Eigen::Vector3f(anywhere(random), anywhere(random), anywhere(random)));
    const PixelBox pixels = pixels_of(lens, box);
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3f p =
          box.min() + box.sizes().cwiseProduct(Eigen::Vector3f(share(random), share(random), share(random)));
      const auto at = camera.project(p.cast<double>());
      ASSERT_TRUE(at);
      if (at->x() < 0 || at->x() > 640 || at->y() < 0 || at->y() > 360) continue;
      EXPECT_GE(at->x(), pixels.x0);
      EXPECT_LE(at->x(), pixels.x1);
      EXPECT_GE(360 - at->y(), pixels.y0);  // counted from below
      EXPECT_LE(360 - at->y(), pixels.y1);
    }
  }
}

TEST(PixelBox, IsAllOfThePictureForWhatReachesBehindTheEyeAndNothingBesideIt) {
  CameraSpec spec;
  spec.yaw = spec.pitch = 0;
  Camera camera(spec);
  camera.set_picture(640, 360, 0);
  camera.fit({Vec3::Constant(-0.1), Vec3::Constant(0.1)});
  const Lens lens = lens_of(camera, 640, 360);
  const Eigen::Vector3f eye = camera.eye().cast<float>();
  EXPECT_EQ(pixels_of(lens, {eye - Eigen::Vector3f::Constant(0.01F), eye + Eigen::Vector3f::Constant(0.01F)}),
            all_pixels(lens));
  EXPECT_TRUE(pixels_of(lens, {Eigen::Vector3f(50, 0, 0), Eigen::Vector3f(51, 1, 1)}).empty());
  EXPECT_TRUE(pixels_of(lens, Eigen::AlignedBox3f()).empty());
}

TEST(PixelBoxes, CoverAllThatWasAddedAndJoinWhatIsNear) {
  PixelBoxes boxes;
  const auto count = [&boxes] {
    int n = 0;
    boxes.for_each([&n](const PixelBox&) { ++n; });
    return n;
  };
  boxes.add(PixelBox{});
  EXPECT_EQ(count(), 0);
  boxes.add(PixelBox{0, 0, 50, 50});
  boxes.add(PixelBox{60, 0, 100, 50});
  EXPECT_EQ(count(), 1) << "near to each other";
  boxes.add(PixelBox{1800, 1000, 1900, 1070});
  EXPECT_EQ(count(), 2) << "at the other end of a large picture";
  std::mt19937 random(5);
  std::uniform_int_distribution<int> x(0, 1900), y(0, 1000);
  std::vector<PixelBox> added;
  PixelBoxes many;
  for (int n = 0; n < 200; ++n) {
    const int x0 = x(random), y0 = y(random);
    added.push_back({x0, y0, x0 + 20, y0 + 20});
    many.add(added.back());
    for (const PixelBox& one : added) {
      bool covered = false;
      many.for_each([&](const PixelBox& box) {
        covered = covered || (box.x0 <= one.x0 && box.y0 <= one.y0 && one.x1 <= box.x1 && one.y1 <= box.y1);
      });
      ASSERT_TRUE(covered) << "box " << n;
    }
  }
}

}  // namespace
}  // namespace palpate::render
