// One mass and planes: what it may move by, which planes push, what an impact leaves.

#include "physics_node/step/plane_contact.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <vector>

namespace palpate::physics {
namespace {

const std::vector<Plane> corner{{Vec3::UnitZ(), 0}, {Vec3(0.6, 0, 0.8), 0}, {-Vec3::UnitX(), -1}};

TEST(PlaneContact, AMassEndsWhereAPlaneIsAndNoDeeperThanItBegan) {
  const KeptOut landed = keep_out({0.5, 0, 0.1}, {0, 0.2, -0.3}, corner, 1e-9);
  EXPECT_LT((landed.D - Vec3(0, 0.2, -0.1)).norm(), 1e-12);
  EXPECT_EQ(landed.at, 1u);
  EXPECT_NEAR(landed.pushed, 0.2, 1e-12);
  const KeptOut inside = keep_out({0.5, 0, -0.1}, {0, 0, -0.3}, std::span(corner).first(1), 1e-9);
  EXPECT_LT(inside.D.norm(), 1e-12) << "it is not thrown out";
  const KeptOut leaves = keep_out({0.5, 0, -0.1}, {0, 0, 0.05}, std::span(corner).first(1), 1e-9);
  EXPECT_EQ(leaves.D, Vec3(0, 0, 0.05));
  EXPECT_EQ(leaves.at, 0u);
}

TEST(PlaneContact, AMassInACornerPassesNoPlane) {
  const Vec3 x(0.1, 0, 0.1);
  const KeptOut kept = keep_out(x, {-2, 0, -2}, corner, 1e-6);
  for (const Plane& plane : corner) EXPECT_GT(plane.n.dot(x + kept.D) - plane.height, -1e-9);
  EXPECT_EQ(kept.at, 2u) << "where x < 0 the slope lies above the floor";
}

// Forces of planes push only, and what is left pulls away from each that was let go.
TEST(PlaneContact, PlanesPushAndDoNotPull) {
  EXPECT_EQ(planes_that_push(7, {0, 0, -1}, corner), 1u);
  EXPECT_EQ(planes_that_push(7, {0, 0, 1}, corner), 0u);
  EXPECT_EQ(planes_that_push(7, {-1, 0, 0.01}, corner), 2u);
  EXPECT_EQ(planes_that_push(3, {-1, 0, -5}, corner), 3u);
  // Against the slope, and away from the floor: the slope alone, though the floor is pressed as well.
  EXPECT_EQ(planes_that_push(3, {-0.6, 0, -0.79}, corner), 2u);
}

TEST(PlaneContact, HeldDirectionsAreAtRightAngles) {
  const HeldDirections two = directions_of(3, corner);
  ASSERT_EQ(two.count, 2);
  EXPECT_NEAR(two.n[0].dot(two.n[1]), 0, 1e-15);
  EXPECT_LT((two.part_of({1, 2, 3}) - Vec3(1, 0, 3)).norm(), 1e-12);
  EXPECT_EQ(directions_of(7, corner).count, 2) << "the third wall lies in their plane";
}

// The inverse in what is left: of A in the directions across n.
TEST(PlaneContact, AHeldBlockIsTheInverseOfTheRest) {
  Eigen::Matrix3d A;
  A << 4, 1, 0.5, 1, 3, -0.7, 0.5, -0.7, 5;
  const Eigen::Matrix3d S = A.inverse();
  double e[6] = {S(0, 0), S(1, 1), S(2, 2), S(1, 2), S(0, 2), S(0, 1)};
  HeldDirections held;
  held.n[0] = Vec3(1, 2, 2) / 3;
  held.count = 1;
  hold_block<double>(held, {e, e + 1, e + 2, e + 3, e + 4, e + 5}, 0);
  Eigen::Matrix3d T;
  T << e[0], e[5], e[4], e[5], e[1], e[3], e[4], e[3], e[2];
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - held.n[0] * held.n[0].transpose();
  EXPECT_LT((T * held.n[0]).norm(), 1e-14);
  EXPECT_LT((T * P * A * P - P).norm(), 1e-14);
}

// With no other force: n . v' = e V, and (1 - e^2) m V^2 / 2 is lost to contact alone.
TEST(PlaneContact, AnImpactTakesWhatItsRestitutionSays) {
  constexpr double m = 2e-3, dt = 1e-3, V = 1, gap = 2e-4;
  const HeldDirections held = directions_of(1, corner);
  const Vec3 v(0.3, 0, -V), D(0.3 * dt, 0, -gap), R(0, 0, m * (V - gap / dt) / dt);
  for (const double e : {0.0, 0.5, 1.0}) {
    const PlaneImpact impact = impact_of(m, v, D, R, held, dt, e, 100);
    EXPECT_NEAR(D.z() / dt + impact.dv.z(), std::max(e * V, -gap / dt), 1e-12);
    EXPECT_NEAR(impact.contact, (1 - e * e) * 0.5 * m * V * V, 1e-15);
    // K' - K + m |v' - v|^2 / 2 of the step itself = R . D, so that all is told:
    const double inertia = 0.5 * m * (V - gap / dt) * (V - gap / dt);
    const double after = D.z() / dt + impact.dv.z();
    EXPECT_NEAR(inertia + impact.numerical + impact.contact, 0.5 * m * (V * V - after * after), 1e-15);
  }
  EXPECT_EQ(impact_of(m, v, D, R, held, dt, 1, 0.25).dv.z() + D.z() / dt, 0.25) << "no faster";
  EXPECT_EQ(impact_of(m, {0, 0, 1}, D, R, held, dt, 1, 100).dv, Vec3::Zero()) << "it did not approach";
}

}  // namespace
}  // namespace palpate::physics
