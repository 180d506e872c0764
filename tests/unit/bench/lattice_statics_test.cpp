// The solver of the reference problems is itself held to what can be worked out by hand.
#include "bench/problems/lattice_statics.h"

#include <gtest/gtest.h>

#include "bench/problems/cube.h"
#include "bench/problems/settings.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"

namespace palpate::bench {
namespace {

physics::Body pair() {
  const Scene scene = pair_scene();
  return physics::build_body(scene.bodies[0], scene.materials);
}

TEST(LatticeStatics, OneElementStretchesByWeightOverStiffness) {
  const Eigen::Matrix3Xd u = equilibrium(pair(), 20 * pair_axis());  // 1 kg, 1000 N/m
  ASSERT_EQ(u.cols(), 2);
  EXPECT_TRUE(u.col(0).isZero());
  EXPECT_LT((u.col(1) - 0.02 * pair_axis()).norm(), 1e-15);
}

TEST(LatticeStatics, LinearAndWholeAnswerAgreeUnderASmallWeight) {
  Scene scene = empty_scene();
  scene.bodies = {box_body(LatticeKind::voxel, Vec3(3, 3, 4), 1.0)};
  scene.bodies[0].fixed_faces[5] = true;
  const physics::Body body = physics::build_body(scene.bodies[0], scene.materials);
  const Vec3 gravity(1e-7, 0, -1e-7);
  const Eigen::Matrix3Xd whole = equilibrium(body, gravity), linear = linear_equilibrium(body, gravity);
  EXPECT_LT((whole - linear).norm(), 1e-5 * whole.norm());
  EXPECT_GT(whole.norm(), 1e-7);
}

TEST(Cube, HoldsAboutAsManyMassesAsAskedFor) {
  for (const LatticeKind lattice : {LatticeKind::fcc, LatticeKind::voxel})
    for (const double masses : {1e3, 3e4}) {
      const Cube cube = make_cube({lattice, Precision::single_, Work::damped, masses});
      EXPECT_NEAR(cube.body->body().lattice.n_masses(), masses, 0.2 * masses);
      EXPECT_GT(cube.step, 0);
    }
}

TEST(Cube, YieldsInEveryStepWhereItIsToYieldAndNeverWhereNot) {
  for (const Work work : {Work::plastic, Work::yielding}) {
    const CubeKind kind{LatticeKind::fcc, Precision::single_, work, 500};
    Cube cube = make_cube(kind);
    set_moving(kind, cube, 1);
    double before = cube.body->losses().plastic;
    for (int n = 0; n < 5; ++n) {
      for (int m = 0; m < 10; ++m) step(cube, 1);
      const double now = cube.body->losses().plastic;
      if (work == Work::yielding) {
        EXPECT_GT(now, before);
      } else {
        EXPECT_EQ(now, 0);
      }
      before = now;
    }
    EXPECT_EQ(cube.body->losses().breaks, 0);
  }
}

}  // namespace
}  // namespace palpate::bench
