#include "deploy/palpate/patient_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace palpate::deploy {
namespace {

constexpr double pi = std::numbers::pi;

Volume with(double a, double b, double c, double d, double e, double f, double g, double h, double i) {
  Volume volume;
  Eigen::Matrix3d m;
  m << a, b, c, d, e, f, g, h, i;
  volume.orientation = m;
  return volume;
}

void expect_view(const PatientView& view, double yaw, double pitch, int axis) {
  EXPECT_NEAR(std::remainder(view.yaw - yaw, 2 * pi), 0, 1e-12);
  EXPECT_NEAR(view.pitch, pitch, 1e-12);
  EXPECT_EQ(view.axis, axis);
}

TEST(PatientViews, OfAnImageThatDoesNotKnowAreThoseOfLps) {
  const PatientViews views = patient_views({});
  expect_view(views.front, 0, 0, 1);
  expect_view(views.side, pi / 2, 0, 0);  // from the left, which is +x
  expect_view(views.top, 0, pi / 2, 2);
}

// The image is left-handed, with y to the front: the body stands with x turned round, and its face looks along +y.
TEST(PatientViews, SeeTheFaceOfALeftHandedImage) {
  const PatientViews views = patient_views(with(1, 0, 0, 0, -1, 0, 0, 0, 1));
  expect_view(views.front, pi, 0, 1);
  expect_view(views.side, -pi / 2, 0, 0);
  expect_view(views.top, pi, pi / 2, 2);
}

// A sagittal stack: x to the back, y to the feet, z to the left, all right-handed or not.
TEST(PatientViews, FollowAnImageThatLies) {
  const PatientViews views = patient_views(with(0, 0, 1, 1, 0, 0, 0, -1, 0));
  ASSERT_LT((with(0, 0, 1, 1, 0, 0, 0, -1, 0).orientation->determinant()), 0);
  // x of the world is then to the front, so one looks along -x at the face; left is up.
  expect_view(views.front, pi / 2, 0, 0);
  expect_view(views.side, pi / 2, pi / 2, 2);
  expect_view(views.top, 0, 0, 1);
}

}  // namespace
}  // namespace palpate::deploy
