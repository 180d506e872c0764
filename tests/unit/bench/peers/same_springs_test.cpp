// The arrays that peers are given are the body that palpate steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/peers/measure.h"

namespace palpate::bench {
namespace {

/// Velocity Verlet on the arrays alone, the plainest loop there is.
std::vector<Vec3> plain_verlet(const SpringBody& body, double dt, int steps) {
  std::vector<Vec3> x = body.rest, v(x.size(), Vec3::Zero());
  const auto accelerations = [&body, &x] {
    std::vector<Vec3> a(x.size(), body.gravity);
    for (const Spring& spring : body.springs) {
      const Vec3 d = x[spring.j] - x[spring.i];
      const Vec3 f = spring.k * (d.norm() - spring.length) / d.norm() * d;
      a[spring.i] += f / body.mass;
      a[spring.j] -= f / body.mass;
    }
    for (std::size_t i = 0; i < a.size(); ++i)
      if (body.held[i] != 0) a[i] = Vec3::Zero();
    return a;
  };
  std::vector<Vec3> a = accelerations();
  for (int n = 0; n < steps; ++n) {
    for (std::size_t i = 0; i < x.size(); ++i) v[i] += 0.5 * dt * a[i], x[i] += dt * v[i];
    a = accelerations();
    for (std::size_t i = 0; i < x.size(); ++i) v[i] += 0.5 * dt * a[i];
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= body.rest[i];
  return x;
}

TEST(SameSprings, APlainLoopOverTheArraysMovesAsPalpateDoes) {
  const Drop drop = make_drop(200);
  const Task task{&drop, 30, 4, true};
  const palpate::bench::Run ours = palpate_reference(Scheme::leapfrog)->run(task);
  ASSERT_TRUE(ours.sound);
  EXPECT_LT(relative_difference(plain_verlet(drop.body, task.dt(), task.steps()), ours.displacement), 1e-11);
}

TEST(SameSprings, TheBottomIsHeldAndTheRestIsNot) {
  const SpringBody body = make_drop(500).body;
  for (std::size_t i = 0; i < body.rest.size(); ++i) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec3& x : body.rest) lowest = std::min(lowest, x.z());
    EXPECT_EQ(body.held[i] != 0, body.rest[i].z() < lowest + 1e-9) << i;
  }
  for (const Spring& spring : body.springs) {
    EXPECT_NEAR((body.rest[spring.j] - body.rest[spring.i]).norm(), spring.length, 1e-15);
    EXPECT_TRUE(body.held[spring.i] == 0 || body.held[spring.j] == 0);
  }
}

TEST(SameSprings, InnerMassesHaveTwelveSprings) {
  const SpringBody body = make_drop(500).body;
  std::vector<int> count(body.rest.size(), 0);
  for (const Spring& spring : body.springs) ++count[spring.i], ++count[spring.j];
  EXPECT_EQ(*std::max_element(count.begin(), count.end()), 12);
}

}  // namespace
}  // namespace palpate::bench
