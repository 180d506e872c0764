// What a body of tetrahedra promises to whoever pushes, saves and books it.
#include "physics_node/step/fem/tet_body.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double dt = 1e-4;  // [s]

std::unique_ptr<BodyModel> small_body(const std::string& keys = "", const std::string& viscosity = "") {
  Recipe recipe = mesh_box({3, 2, 2}, 0.01);
  recipe.body = keys;
  recipe.material += viscosity;
  auto body = make_body_model(body_of(recipe), Precision::double_);
  body->prepare_for(Disturbance::impulses);
  return body;
}

void stir(BodyModel& body, double displacement, double velocity) {
  Dice dice(1);
  for (const Index node : body.body().nodes())
    body.place(node, dice.within(displacement), dice.within(velocity));
}

struct Seen {
  Vec3 x, v, v_move;
};
Seen seen(const BodyModel& body, Index node) {
  const std::uint32_t which = 0;
  const Vec3 rest = body.body().rest_position(node);
  Seen now;
  body.read({&which, 1}, {&node, 1}, {&rest, 1}, dt, {&now.x, 1}, {&now.v, 1}, {&now.v_move, 1});
  return now;
}

TEST(TetBody, IsReadWhereItsStepBegan) {
  const auto body = small_body();
  stir(*body, 1e-4, 0.1);
  const Index node = 7;
  const Vec3 before = body->position(node), v_before = body->velocity(node);
  body->remember_velocities();
  body->advance({.dt = dt}, {});
  const Seen now = seen(*body, node);
  EXPECT_LT((now.x - before).norm(), 1e-15);
  EXPECT_LT((now.v_move - body->velocity(node)).norm(), 1e-15);
  EXPECT_LT((now.v - 0.5 * (v_before + body->velocity(node))).norm(), 1e-15);
}

TEST(TetBody, APushActsAsIfAtTheBeginningOfTheStep) {
  const auto body = small_body();
  stir(*body, 1e-4, 0.1);
  const Index node = 7;
  body->remember_velocities();
  body->advance({.dt = dt}, {});
  const Seen before = seen(*body, node);
  const Vec3 x = body->position(node), dv(0.1, -0.2, 0.3);
  const NodalPush push{node, dv};
  body->push({&push, 1}, dt);
  const Seen after = seen(*body, node);
  EXPECT_LT((body->position(node) - x - dt * dv).norm(), 1e-15);
  EXPECT_LT((after.x - before.x).norm(), 1e-15) << "where the step began";
  EXPECT_LT((after.v - before.v - dv).norm(), 1e-15) << "all of it, not half";
  EXPECT_LT((after.v_move - before.v_move - dv).norm(), 1e-15);
  EXPECT_TRUE(body->touched());
}

TEST(TetBody, AForceIsAPushByItsImpulse) {
  const auto pushed = small_body(), kicked = small_body();
  const Index node = 7;
  const Vec3 force(0.01, 0.02, -0.03);
  const NodalForce nodal{node, force};
  const NodalPush push{node, dt / node_mass(pushed->body(), node) * force};
  pushed->advance({.dt = dt}, {});
  pushed->push({&push, 1}, dt);
  kicked->advance({.dt = dt}, {&nodal, 1});
  EXPECT_LT((pushed->position(node) - kicked->position(node)).norm(), 1e-18);
  EXPECT_LT((pushed->velocity(node) - kicked->velocity(node)).norm(), 1e-15);
  EXPECT_NEAR(kicked->power({&nodal, 1}), force.dot(kicked->velocity(node)), 1e-18);
  EXPECT_LT((kicked->momenta().linear - dt * force).norm(), 1e-18);
  const MomentumBalance balance = kicked->momentum_balance();
  EXPECT_LT(balance.missing.linear.norm(), 1e-15 * balance.linear);
  EXPECT_LT(balance.missing.angular.norm(), 1e-15 * balance.angular + 1e-24);
}

TEST(TetBody, WhatIsHeldStays) {
  const auto body = small_body("fixed = [\"-z\"]");
  Index held = -1;
  for (const Index node : body->body().nodes())
    if (body->body().inverse_mass[static_cast<std::size_t>(node)] == 0) held = node;
  ASSERT_GE(held, 0);
  const NodalForce force{held, {1, 1, 1}};
  const NodalPush push{held, {1, 1, 1}};
  body->place(held, {1, 1, 1}, {1, 1, 1});
  body->advance({.dt = dt, .gravity = {0, 0, -9.81}}, {&force, 1});
  body->push({&push, 1}, dt);
  EXPECT_EQ(body->displacement(held), Vec3::Zero());
  EXPECT_EQ(body->velocity(held), Vec3::Zero());
  EXPECT_EQ(body->power({&force, 1}), 0);
  EXPECT_EQ(body->bounce_off({Vec3::UnitZ(), 1}, 1, dt).masses, body->body().n_nodes() - body->body().n_held)
      << "all others are behind that plane and fall";
}

TEST(TetBody, GoesBackToTheLastGoodStateAtRest) {
  const auto body = small_body();
  stir(*body, 1e-4, 0.1);
  const Index node = 7;
  const Vec3 good = body->displacement(node);
  body->save(false), body->save(true);
  body->advance({.dt = dt, .watch = true}, {});
  body->place(node, {std::nan(""), 0, 0}, Vec3::Zero());
  EXPECT_FALSE(body->is_finite());
  body->restore();
  EXPECT_TRUE(body->is_finite());
  EXPECT_EQ(body->displacement(node), good);
  EXPECT_EQ(body->velocity(node), Vec3::Zero());
}

TEST(TetBody, IsAfterAResetAsItWasLoaded) {
  const auto body = small_body("velocity_m_per_s = [1, 2, 3]", "\nviscosity_Pa_s = 1"),
             other = small_body("velocity_m_per_s = [1, 2, 3]", "\nviscosity_Pa_s = 1");
  EXPECT_EQ(body->velocity(7), Vec3(1, 2, 3));
  stir(*body, 1e-3, 1);
  for (int n = 0; n < 10; ++n) body->advance({.dt = dt, .watch = true}, {});
  EXPECT_GT(body->losses().viscous, 0);
  body->reset();
  EXPECT_EQ(body->losses().viscous, 0);
  for (int n = 0; n < 10; ++n)
    for (auto* one : {body.get(), other.get()}) one->advance({.dt = dt, .watch = true}, {});
  EXPECT_EQ(body->hash(1), other->hash(1));
  EXPECT_EQ(body->watch().energy(), other->watch().energy());
}

/// However the last step was watched: what a damped body has, and has lost and will book at once, is what it began with.
TEST(TetBody, BooksWhatItsDamperTakes) {
  const auto body = small_body("", "\nviscosity_Pa_s = 2");
  stir(*body, 1e-4, 0.05);
  body->advance({.dt = dt, .watch = true}, {});
  const auto all = [&] {
    const Energies e = body->energies(Vec3::Zero());
    return e.between + e.elastic;
  };
  const auto lost = [&] { return body->losses().viscous + body->due().viscous; };
  const double start = all(), lost_before = lost();
  for (int n = 1; n <= 50; ++n) {
    body->advance({.dt = dt, .watch = n % 4 == 0}, {});
    EXPECT_NEAR(all() + lost() - lost_before, start, 2e-3 * start) << n;
  }
  EXPECT_GT(lost() - lost_before, 0.1 * start);
}

TEST(TetBody, BouncesWithItsEnergyOrWithout) {
  for (const double e : {1.0, 0.0}) {
    const auto body = small_body("velocity_m_per_s = [0.5, 0, -1]");
    body->remember_velocities();
    body->advance({.dt = dt}, {});
    const double mass = 1000 * 0.03 * 0.02 * 0.02;
    const Bounces all = body->bounce_off({Vec3::UnitZ(), 1}, e, dt);  // far above it
    EXPECT_EQ(all.masses, body->body().n_nodes());
    EXPECT_NEAR(all.lost, e == 1 ? 0 : 0.5 * mass, 1e-9);
    for (const Index node : body->body().nodes())
      EXPECT_LT((body->velocity(node) - Vec3(0.5, 0, e)).norm(), 1e-12);
    EXPECT_EQ(body->bounce_off({Vec3::UnitZ(), 1}, e, dt).masses, 0) << "none approaches any more";
  }
}

TEST(TetBody, CountsItsTetrahedraAndHowFarTheyAreStretched) {
  const auto body = small_body();
  Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d stretch = Vec3(1.2, 0.7, 1).asDiagonal();
  for (const Index node : body->body().nodes()) {
    const Vec3 rest = body->body().rest_position(node);
    body->place(node, turn * stretch * rest - rest, Vec3::Zero());
  }
  const BodyCounts counts = body->counts();
  EXPECT_EQ(counts.elements, 3 * 2 * 2 * 6);
  EXPECT_EQ(counts.live_elements, counts.elements);
  EXPECT_NEAR(counts.max_stretch, 1.2, 1e-12);
  EXPECT_GT(counts.shape_rms, 0);
  body->advance({.dt = 1e-9, .watch = true}, {});
  EXPECT_NEAR(*body->counts().least_corner_J, 1.2 * 0.7, 1e-9);
}

}  // namespace
}  // namespace palpate::physics::test
