#include "render_node/view/camera.h"
#include "common/scene/render_spec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace palpate::render {
namespace {

CameraSpec level(double yaw = 0) {
  CameraSpec spec;
  spec.yaw = yaw;
  spec.pitch = 0;
  spec.target = Vec3(1, 2, 3);
  spec.distance = 2.0;
  return spec;
}

TEST(Camera, StandsOnTheNegativeYSideAtYawZero) {
  const Camera camera(level());
  EXPECT_TRUE(camera.eye().isApprox(Vec3(1, 0, 3), 1e-12));
}

TEST(Camera, ProjectsKnownPoints) {
  Camera camera(level());
  camera.set_picture(800, 600, 0);
  const double half_height = 2.0 * std::tan(0.3);  // field of view 0.6 rad, distance 2 m
  const auto at = [&](double x, double z) { return *camera.project(Vec3(1 + x, 2, 3 + z)); };
  EXPECT_TRUE(at(0, 0).isApprox(Eigen::Vector2d(400, 300), 1e-9));
  EXPECT_NEAR(at(0, half_height).y(), 0, 1e-9);  // up is up
  EXPECT_NEAR(at(0, -half_height).y(), 600, 1e-9);
  EXPECT_NEAR(at(half_height, 0).x(), 700, 1e-9);  // x to the right
  EXPECT_FALSE(camera.project(Vec3(1, -5, 3)).has_value());
}

TEST(Camera, PutsTheTargetInTheMiddleOfTheFreePart) {
  Camera camera(level(0.7));
  camera.set_picture(1280, 720, 300);
  EXPECT_TRUE(camera.project(camera.target())->isApprox(Eigen::Vector2d(790, 360), 1e-9));
}

TEST(Camera, TurningKeepsTheDistance) {
  Camera camera(level());
  for (int i = 0; i < 100; ++i) camera.rotate(37, i % 2 == 0 ? 60 : -45);
  EXPECT_NEAR((camera.eye() - camera.target()).norm(), 2.0, 1e-12);
  const Eigen::Matrix3d axes = camera.view().topLeftCorner<3, 3>();
  EXPECT_TRUE(axes.isUnitary(1e-12));
  EXPECT_NEAR(axes.determinant(), 1.0, 1e-12);
}

TEST(Camera, TheObjectTurnsWithTheHand) {
  Camera camera(level());
  camera.set_picture(800, 600, 0);
  const Vec3 nose(1, 1.8, 3);  // on the near side
  const double before = camera.project(nose)->x();
  camera.rotate(40, 0);
  EXPECT_GT(camera.project(nose)->x(), before);
  const double height = camera.project(nose)->y();
  camera.rotate(0, 40);
  EXPECT_GT(camera.project(nose)->y(), height);
}

TEST(Camera, PanningMovesTheTargetWithTheHand) {
  Camera camera(level(0.4));
  camera.set_picture(800, 600, 0);
  const Vec3 target = camera.target();
  camera.pan(50, -20);
  EXPECT_TRUE(camera.project(target)->isApprox(Eigen::Vector2d(450, 280), 1e-9));
}

TEST(Camera, FitsABoxIntoTheFreePart) {
  CameraSpec spec;
  Camera camera(spec);
  camera.set_picture(1280, 720, 308);
  const Eigen::AlignedBox3d box(Vec3(-0.1, -0.12, 0.0), Vec3(0.1, 0.12, 0.3));
  camera.fit(box);
  double top = 720, bottom = 0, left = 1280, right = 0;
  for (int i = 0; i < 8; ++i) {
    const auto p = *camera.project(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
    top = std::min(top, p.y());
    bottom = std::max(bottom, p.y());
    left = std::min(left, p.x());
    right = std::max(right, p.x());
  }
  const double air = std::min({top, 720 - bottom, left - 308, 1280 - right});
  EXPECT_GT(air, 0);
  EXPECT_LT(air, 72);  // and it is not small
}

/// Whatever the scene says, all eight corners come into the free part, seen from the side that was asked for.
TEST(Camera, LooksFromASideWithAllInThePicture) {
  Camera camera(level());
  camera.set_picture(1280, 720, 300);
  const Eigen::AlignedBox3d box(Vec3(-0.2, -0.1, 0), Vec3(0.3, 0.1, 0.05));
  const auto sees_all = [&] {
    for (int i = 0; i < 8; ++i) {
      const auto p = camera.project(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
      if (!p || p->x() < 300 || p->x() > 1280 || p->y() < 0 || p->y() > 720) return false;
    }
    return true;
  };
  camera.fit(box);
  EXPECT_FALSE(sees_all()) << "the scene looks elsewhere";
  const double quarter = std::acos(0.0);
  struct View {
    double yaw, pitch;
    Vec3 from;
  };
  for (const View& view :
       {View{0, 0, -Vec3::UnitY()}, View{quarter, 0, Vec3::UnitX()}, View{0, quarter, Vec3::UnitZ()}}) {
    camera.rotate(30, 20);  // a hand has moved it
    camera.look_from(view.yaw, view.pitch);
    camera.fit(box);
    EXPECT_TRUE(sees_all());
    EXPECT_GT((camera.eye() - camera.target()).normalized().dot(view.from), 0.999);
  }
  camera.reset();
  camera.fit(box);
  EXPECT_TRUE(camera.eye().isApprox(Vec3(1, 0, 3), 1e-12)) << "the scene's view again";
  camera.fit_all();
  camera.fit(box);
  EXPECT_TRUE(sees_all());
}

TEST(Camera, LooksAtAPointSoNearThatAHeightFillsThePicture) {
  Camera camera(level(0.4));
  camera.set_picture(800, 600, 0);
  const Vec3 p(0.1, 0.2, 0.3), up = camera.axes().row(1).transpose();
  camera.look_at(p, 0.06);
  EXPECT_LT((*camera.project(p) - Eigen::Vector2d(400, 300)).norm(), 1e-9);
  EXPECT_NEAR(camera.project(p + 0.03 * up)->y(), 0, 1e-6);
  EXPECT_NEAR(camera.pixels_per_metre(), 600 / 0.06, 1e-6);
  camera.fit({Vec3::Constant(-1), Vec3::Constant(1)});
  EXPECT_EQ(camera.target(), p) << "a hand has moved it";
}

TEST(Camera, DoesNotFitAgainOnceAHandMovedIt) {
  Camera camera(CameraSpec{});
  const Eigen::AlignedBox3d box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  camera.fit(box);
  camera.zoom(3);
  const double distance = camera.distance();
  camera.fit(box);
  EXPECT_EQ(camera.distance(), distance);
  camera.reset();
  camera.fit(box);
  EXPECT_GT(camera.distance(), distance);
}

}  // namespace
}  // namespace palpate::render
