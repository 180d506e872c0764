// Laws of friction: within the cone, stick and slip, no energy from a closed path, and nothing at all without it.

#include "haptic_node/contact/friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "haptic_node/contact/local_contact.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

constexpr double k = 400;  // [N/m]

TEST(Friction, SticksAsASpringAndSlidesOnTheConesEdge) {
  constexpr double mu = 0.5, pressing = 2.0;
  Friction friction(mu);
  const Vec3 normal(0, 0, pressing);
  EXPECT_EQ(friction.tick({0, 0, 0}, normal, k), Vec3::Zero()) << "contact begins without friction";
  // 1. sticks up to mu F_n / k = 2.5 mm, and goes back the same way
  for (const double x : {1e-3, 2.4e-3, 1e-3, -2e-3, 0.0}) {
    const Vec3 f = friction.tick({x, 0, -0.005}, normal, k);
    EXPECT_NEAR(f.x(), -k * x, 1e-12);
    EXPECT_EQ(f.y(), 0);
    EXPECT_EQ(f.z(), 0);
    EXPECT_FALSE(friction.slips());
  }
  // 2. slides with mu F_n against the motion
  for (int i = 1; i <= 100; ++i) {
    const Vec3 f = friction.tick({1e-4 * i, 0, 0}, normal, k);
    if (i > 25) {
      EXPECT_TRUE(friction.slips());
      EXPECT_NEAR(f.x(), -mu * pressing, 1e-12);
    }
  }
  // 3. sticks again where it stopped: backwards the force first falls, then turns
  EXPECT_NEAR(friction.tick({0.0100 - 0.0025, 0, 0}, normal, k).x(), 0.0, 1e-12);
  EXPECT_FALSE(friction.slips());
  EXPECT_NEAR(friction.tick({0.0100 - 0.0080, 0, 0}, normal, k).x(), mu * pressing, 1e-12);
  EXPECT_TRUE(friction.slips());
  // 4. lifted, it has forgotten
  EXPECT_EQ(friction.tick({0, 0, 0.01}, Vec3::Zero(), k), Vec3::Zero());
  EXPECT_EQ(friction.stored(), 0);
  EXPECT_EQ(friction.tick({0.5, 0, 0}, normal, k), Vec3::Zero());
}

/// Random walks of hand, normal force, its direction and the stiffness; the seed is printed with a failure.
TEST(Friction, StaysWithinItsConeWhateverHappens) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> g;
    std::uniform_real_distribution<double> u;
    const double mu = 1.5 * u(random);
    Friction friction(mu);
    Vec3 x = Vec3::Zero(), normal(0, 0, 1);
    for (int i = 0; i < 2000; ++i) {
      x += 2e-4 * Vec3(g(random), g(random), g(random));
      normal += 0.1 * Vec3(g(random), g(random), g(random));
      if (i % 50 == 0) normal *= i % 100 == 0 ? 0.0 : 10.0;
      const double stiffness = 50 + 950 * u(random);
      const Vec3 f = friction.tick(x, normal, stiffness);
      ASSERT_LE(f.norm(), mu * normal.norm() * (1 + 1e-12)) << "seed " << seed;
      ASSERT_NEAR(f.dot(normal), 0, 1e-9 * (1 + f.norm() * normal.norm())) << "seed " << seed;
      ASSERT_NEAR(friction.stored(), 0.5 * f.squaredNorm() / stiffness, 1e-15) << "seed " << seed;
    }
  }
}

/// W = sum of F . dx on the hand, by the trapezoidal rule: less than what was stored at the start, which is nothing.
TEST(Friction, GivesNoEnergyOnClosedPaths) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> g;
    Vec3 a[4], b[4];
    for (int j = 0; j < 4; ++j) {
      a[j] = 2e-3 * Vec3(g(random), g(random), 0);
      b[j] = 2e-3 * Vec3(g(random), g(random), 0);
    }
    const auto at = [&](double s) {
      Vec3 x = Vec3::Zero();
      for (int j = 0; j < 4; ++j) x += a[j] * (std::cos((j + 1) * s) - 1) + b[j] * std::sin((j + 1) * s);
      return x;
    };
    Friction friction(0.4);
    constexpr int steps = 20000;
    double work = 0, most = 0;
    Vec3 x = at(0), force = friction.tick(x, {0, 0, 1.5}, k);
    for (int i = 1; i <= 2 * steps; ++i) {
      const double s = 2 * M_PI * i / steps;
      const Vec3 next = at(s);
      const double pressing = 1.5 + std::sin(3 * s), stiffness = k * (1 + 0.5 * std::sin(7 * s));
      const Vec3 f = friction.tick(next, {0, 0, pressing}, stiffness);
      work += 0.5 * (f + force).dot(next - x);
      most = std::max(most, work + friction.stored());
      x = next;
      force = f;
    }
    ASSERT_LT(x.norm(), 1e-9) << "the path is closed";
    ASSERT_LT(work, 0) << "seed " << seed;
    ASSERT_LE(most, 1e-7) << "seed " << seed << ": it never gives more than was put in";
  }
}

/// The hand on a flat patch: presses 2 mm deep, then along x and back. @return forces of all ticks
std::vector<Vec3> rub(double mu, double damping) {
  LocalContact contact(k, damping, 5.0, mu);
  contact.take(flat_patch(1), 1e-3);
  std::vector<Vec3> forces;
  const auto go = [&](const Vec3& from, const Vec3& to, int ticks) {
    for (int i = 1; i <= ticks; ++i)
      forces.push_back(
          contact.tick(from + (to - from) * (1.0 * i / ticks), (to - from) / (1e-3 * ticks), 1e-3).force);
  };
  go({0, 0, 0.002}, {0, 0, -0.002}, 200);
  go({0, 0, -0.002}, {0.01, 0, -0.002}, 400);
  go({0.01, 0, -0.002}, {0, 0, -0.001}, 400);
  return forces;
}

TEST(LocalContactFriction, LeavesTheForceAcrossTheSurfaceAsItIs) {
  for (const double damping : {0.0, 1.0}) {
    const auto slippery = rub(0, damping), rough = rub(0.6, damping);
    double along = 0;
    for (std::size_t i = 0; i < slippery.size(); ++i) {
      ASSERT_EQ(slippery[i].x(), 0);
      ASSERT_EQ(slippery[i].y(), 0);
      ASSERT_EQ(rough[i].z(), slippery[i].z()) << "bit by bit";
      ASSERT_LE(std::hypot(rough[i].x(), rough[i].y()), 0.6 * rough[i].z() * (1 + 1e-12));
      along = std::max(along, std::abs(rough[i].x()));
    }
    EXPECT_NEAR(along, 0.6 * k * 0.002, 1e-6);
  }
}

TEST(LocalContactFriction, ShowsTheProxyWhereItSticks) {
  LocalContact contact(k, 0, 5.0, 0.8);
  contact.take(flat_patch(1), 1e-3);
  ContactResult felt;
  for (int i = 0; i <= 200; ++i) felt = contact.tick({0, 0, 0.002 - 2e-5 * i}, Vec3::Zero(), 1e-3);
  for (int i = 0; i <= 100; ++i) felt = contact.tick({1e-5 * i, 0, -0.002}, Vec3::Zero(), 1e-3);
  EXPECT_NEAR(felt.proxy.x(), 0.0, 1e-8);
  EXPECT_NEAR(felt.proxy.z(), 0.0, 1e-8);
  EXPECT_NEAR(felt.force.x(), -k * 1e-3, 1e-5);
}

/// The whole hand: a mass led along a rough surface is held back, and gets no energy out of it.
TEST(HapticSessionFriction, HoldsTheHandBackAndGivesNoEnergy) {
  const auto lead = [](double mu) {
    Scene scene = scene_with(HandModel::arm, {{0, {-0.02, 0, 0.01}},
                                              {0.5, {-0.02, 0, -0.004}},
                                              {1.5, {0.02, 0, -0.004}},
                                              {2.5, {-0.02, 0, -0.004}},
                                              {3, {-0.02, 0, 0.01}}});
    scene.tools[0].friction = mu;
    return scene;
  };
  VirtualWorld smooth(lead(0)), rough(lead(0.5));
  double most = 0, lag = 0;
  for (int i = 0; i < 3500; ++i) {
    smooth.run(1e-3, 150);
    rough.run(1e-3, 150);
    const Array3& f = rough.session.trace().force;
    ASSERT_LE(std::hypot(f[0], f[1]), 0.5 * f[2] + 1e-9);
    most = std::max(most, rough.session.trace().energy);
    lag = std::max(lag, smooth.session.tool_state().p_WT[0] - rough.session.tool_state().p_WT[0]);
  }
  EXPECT_GT(lag, 5e-4);
  EXPECT_LE(most, 1e-4) << "0.1 mJ";
  EXPECT_LT(rough.session.trace().energy, smooth.session.trace().energy - 1e-3) << "friction takes energy";
}

}  // namespace
}  // namespace palpate::haptic::test
