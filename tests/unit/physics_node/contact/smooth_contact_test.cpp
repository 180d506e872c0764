// Tools on a smooth skin: what its vertices bear goes to the masses that carry them, and a tip slides over a ball as
// over a ball.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics_node/contact/face_press.h"
#include "physics_node/contact/stick_faces.h"
#include "physics_node/contact/tool_contact.h"
#include "physics_node/step/body_model.h"
#include "tests/support/physics/smooth_image.h"

namespace palpate::physics {
namespace {

using namespace test;

const Vec3 middle_m = 1e-3 * Vec3(0.37, -0.21, 0.55);

struct Bench {
  explicit Bench(const SmoothImage& image = {})
      : moving(make_body_model(image.body(), Precision::double_)), surface(*moving, 0.02) {
    for (std::uint32_t f = 0; f < surface.surface().facets.size(); ++f) facets.push_back(f);
  }
  std::unique_ptr<BodyModel> moving;
  Boundary surface;
  std::vector<std::uint32_t> facets;
};

TEST(SmoothContact, BearsTheForceAndItsMomentAboutTheMiddleOfASphere) {
  Bench bench;
  for (const Vec3& out : {Vec3(0, 0, 1), Vec3(1, 2, 3), Vec3(-3, 1, 0.3)}) {
    FacePress press(bench.surface, *bench.moving, RigidShape::sphere(0.005));
    const Vec3 n = out.normalized();
    const ShapePose pose = pose_along(middle_m + 0.0183 * n, n);
    press.list(pose, bench.facets);
    ASSERT_TRUE(press.press(pose, 0.1, 1e-6));
    const Vec3 centre = pose.tip + (0.005 - press.depth()) * n;
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (const NodalForce& nodal : press.forces()) {
      sum += nodal.force;
      moment += (bench.moving->position(nodal.cell) - centre).cross(nodal.force);
    }
    EXPECT_NEAR(sum.dot(n), -0.1, 1e-12);
    EXPECT_LT(moment.norm(), 1e-4 * 0.1 * 0.005);
    EXPECT_NEAR(press.depth(), 0, 0.0004);  // the ball is where it is drawn
  }
}

/// However long a step is, vertices go hardly further than the shape in it.
TEST(SmoothContact, NeverPushesItsVerticesBeyondTheShape) {
  for (const double dt : {1e-5, 1e-4, 1e-3}) {
    Bench bench;
    FacePress press(bench.surface, *bench.moving, RigidShape::sphere(0.006));
    const ShapePose pose = pose_along(middle_m + 0.0183 * Vec3::UnitZ(), Vec3::UnitZ());
    press.list(pose, bench.facets);
    ASSERT_TRUE(press.press(pose, 0.05, dt));
    for (const NodalForce& nodal : press.forces()) {
      const double m = 1 / bench.moving->body().inverse_mass[static_cast<std::size_t>(nodal.cell)];
      const Vec3 moved = bench.moving->displacement(nodal.cell) + dt * dt / m * nodal.force;
      bench.moving->place(nodal.cell, moved, Vec3::Zero());
    }
    ASSERT_GT(press.depth(), 0);
    for (const std::uint32_t f : bench.facets)
      for (std::size_t c = 0; c < 4; ++c) {
        const Vec3 moved = bench.surface.position(f, c, *bench.moving) - bench.surface.rest(f, c);
        EXPECT_LT(-moved.z(), 1.25 * press.depth() + 1e-4) << dt;
      }
  }
}

TEST(SmoothContact, SharesAForceSoThatItDoesTheSameWork) {
  Bench bench;
  ToolContact contact(bench.surface, *bench.moving, 0.003);
  const Vec3 p = middle_m + 0.0185 * Vec3(0.6, 0, 0.8);
  contact.look(p, 0);
  const LocalPlane before = contact.plane_under(p);
  contact.find_shares(p);
  double sum = 0;
  Vec3 at = Vec3::Zero();
  for (const MassShare& share : contact.shares()) {
    sum += share.share;
    at += share.share * bench.moving->position(share.cell);
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  // Shares are those of the plane's point under the place itself.
  const Vec3 foot = p - before.normal.dot(p - before.point) * before.normal;
  EXPECT_LT((at - contact.plane_under(foot).point).norm(), 2e-5);
}

/// A face of a skin that bears a stick is pushed by as much as it gives the stick, and about the same point.
TEST(SmoothContact, GivesAStickWhatItTakes) {
  Bench bench;
  StickFaces faces(bench.surface, *bench.moving, 0.0008);
  const Vec3 up = Vec3(0.2, 0.1, 1).normalized();
  const Vec3 tip = middle_m + 0.0186 * up;
  const Stick now{tip, 0.03 * up, 0.0008}, before{tip + 0.0004 * up, 0.03 * up, 0.0008};
  faces.list(now, 0.004);
  ASSERT_GT(faces.size(), 0u);
  ContactSum sum;
  std::uint32_t contacts = 0;
  faces.lead(before, now, tip, 1e-3, sum, contacts);
  ASSERT_GT(contacts, 0u);
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  for (const Index node : bench.moving->body().nodes()) {
    const double inverse = bench.moving->body().inverse_mass[static_cast<std::size_t>(node)];
    momentum += bench.moving->velocity(node) / inverse;
    angular += (bench.moving->position(node) - tip).cross(bench.moving->velocity(node) / inverse);
  }
  EXPECT_GT(momentum.norm(), 1e-9);
  EXPECT_LT((momentum + sum.impulse.head<3>()).norm(), 1e-12 * momentum.norm());
  EXPECT_LT((angular + sum.impulse.tail<3>()).norm(), 1e-6 * momentum.norm() * 0.0008);
}

struct Ripple {
  double p_p = 0, rms = 0, turn = 0;  // [m], [m], [deg]
};
/// A tip of 3 mm goes round a ball of 80 mm, of which the image holds a slice.
Ripple ripple_of(SkinKind skin) {
  SmoothImage image;
  image.size = {86, 14, 86};
  const Vec3 centre(0.7, 0.4, -0.3);
  image.phi = ball_mm(80, centre);
  image.skin = skin;
  image.model = ElementModel::springs;
  Bench bench(image);
  ToolContact contact(bench.surface, *bench.moving, 0.003);
  std::vector<double> height;
  Ripple ripple;
  for (double way = -50; way <= 50; way += 0.1) {  // [mm] along the great circle
    const double angle = way / 80 + 0.3;
    const Vec3 out(std::sin(angle), 0, std::cos(angle));
    const Vec3 p = 1e-3 * (centre + 80 * out);
    contact.look(p, 1e-3 * way);
    const LocalPlane plane = contact.plane_under(p);
    EXPECT_TRUE(plane.found);
    height.push_back(plane.normal.dot(plane.point - p) / plane.normal.dot(out));
    ripple.turn =
        std::max(ripple.turn, std::acos(std::min(1.0, plane.normal.dot(out))) * 180 / std::numbers::pi);
  }
  double mean = 0;
  for (const double h : height) mean += h / static_cast<double>(height.size());
  for (const double h : height) ripple.rms += (h - mean) * (h - mean) / static_cast<double>(height.size());
  ripple.rms = std::sqrt(ripple.rms);
  ripple.p_p =
      *std::max_element(height.begin(), height.end()) - *std::min_element(height.begin(), height.end());
  std::printf("%s: ripple %.4f mm rms, %.3f mm from top to bottom, direction off by %.2f degrees at most\n",
              skin == SkinKind::smooth ? "smooth" : "bricks", 1e3 * ripple.rms, 1e3 * ripple.p_p,
              ripple.turn);
  return ripple;
}

TEST(SmoothContact, SlidesOverABallAsOverABall) {
  const Ripple smooth = ripple_of(SkinKind::smooth), bricks = ripple_of(SkinKind::bricks);
  EXPECT_LT(smooth.p_p, 0.15e-3);
  EXPECT_LT(smooth.turn, 1.2);
  // Of a spring of 40 % a millimetre: 1.5 % of the force.
  EXPECT_LT(0.4 * 1e3 * smooth.rms, 0.015);
  EXPECT_GT(bricks.p_p, 3 * smooth.p_p);
  EXPECT_GT(bricks.turn, 3 * smooth.turn);
}

}  // namespace
}  // namespace palpate::physics
