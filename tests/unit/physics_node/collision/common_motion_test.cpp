#include "physics_node/collision/common_motion.h"

#include <gtest/gtest.h>

#include "common/scene/scene.h"
#include "physics_node/step/body_model.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Recipe;

struct Fell {
  std::int64_t steps = 0, collisions = 0, rebuilds = 0;
  std::vector<Vec3> at;  // every mass, from where the heap has got to [m]
};

/// A body shaken until it breaks to pieces that hit each other, all of it flying.
Fell heap_that_flies(const Vec3& velocity) {
  Recipe recipe = test::fragile("fcc", Recipe::box(40, 40, 40));
  recipe.world = "[contact]\ndistance = \"swept\"\n";
  World world(test::scene_of(recipe));
  test::Dice dice(3);
  BodyModel& body = world.body(0);
  for (const Index cell : body.body().lattice.masses)
    body.place(cell, Vec3::Zero(), velocity + dice.within(2));
  world.restart_ledger();
  for (int frame = 0; frame < 10; ++frame) world.frame({});
  const CollisionTally& tally = world.collisions()->tally();
  Fell fell{
      .steps = world.report().steps, .collisions = tally.collisions, .rebuilds = tally.rebuilds, .at = {}};
  for (const Index cell : body.body().lattice.masses)
    fell.at.push_back(body.position(cell) - world.t() * velocity);
  return fell;
}

TEST(CommonMotion, AHeapThatFliesTouchesLikeOneThatRests) {
  const Fell rests = heap_that_flies(Vec3::Zero()), flies = heap_that_flies({1000, -300, 200});
  EXPECT_GT(rests.collisions, 10);
  EXPECT_EQ(flies.steps, rests.steps);
  EXPECT_EQ(flies.collisions, rests.collisions);
  EXPECT_LE(flies.rebuilds, rests.rebuilds + 2);
  for (std::size_t n = 0; n < rests.at.size(); ++n)
    EXPECT_LT((flies.at[n] - rests.at[n]).norm(), 1e-8) << "mass " << n;
}

struct Lumps {
  std::vector<std::unique_ptr<BodyModel>> moving;
  std::vector<ContactBody> bodies;

  Lumps(const Vec3& first, const Vec3& second) {
    for (const Vec3& velocity : {first, second}) {
      moving.push_back(make_body_model(test::body_of({}), Precision::double_));
      for (const Index cell : moving.back()->body().lattice.masses)
        moving.back()->place(cell, Vec3::Zero(), velocity);
    }
    bodies.reserve(2);
    for (auto& body : moving) bodies.emplace_back(*body, true, false);
    for (auto& body : bodies) body.refresh(0);
  }
};

TEST(CommonMotion, IsThatOfEachBody) {
  const Lumps lumps({100, 0, 0}, {104, 0, 2});
  EXPECT_EQ(common_velocity(lumps.bodies[0], Vec3::Zero(), 1), Vec3(100, 0, 0));
  EXPECT_EQ(common_velocity(lumps.bodies[1], Vec3::Zero(), 1), Vec3(104, 0, 2));
  EXPECT_EQ(common_velocity(lumps.bodies[1], Vec3::Zero(), 200), Vec3::Zero());
}

TEST(CommonMotion, IsThatOfMostAndNoneOfAHalf) {
  Lumps lumps({100, 0, 0}, {0, 0, 0});
  BodyModel& body = *lumps.moving[0];
  const auto& masses = body.body().lattice.masses;
  const auto rest_every = [&](std::size_t nth) {
    for (std::size_t n = 0; n < masses.size(); n += nth) body.place(masses[n], Vec3::Zero(), Vec3::Zero());
    lumps.bodies[0].refresh(0);
    return common_velocity(lumps.bodies[0], Vec3::Zero(), 1);
  };
  EXPECT_EQ(rest_every(7), Vec3(100, 0, 0));
  EXPECT_EQ(rest_every(2), Vec3::Zero());
}

// As fast as the bodies fly together, each goes by the same against that.
TEST(CommonMotion, IsTheSameHoweverFastAllFly) {
  for (const double speed : {0.0, 10.0, 1000.0}) {
    Lumps lumps(Vec3(speed, 0, 0), Vec3(speed - 6, 0, 0));
    BodyModel& body = *lumps.moving[1];
    const auto& masses = body.body().lattice.masses;
    for (std::size_t n = 0; n < masses.size(); n += 3)  // a third of the second has been stopped
      body.place(masses[n], Vec3::Zero(), Vec3(speed, 0, 0));
    lumps.bodies[1].refresh(0);
    const Vec3 usual = usual_velocity(lumps.bodies, 1);
    EXPECT_EQ(usual, Vec3(speed, 0, 0));
    EXPECT_EQ(common_velocity(lumps.bodies[0], usual, 1), usual);
    EXPECT_EQ(common_velocity(lumps.bodies[1], usual, 1), usual) << "too many are slower";
  }
}

TEST(CommonMotion, IsNoMotionOfACandidate) {
  Lumps lumps({100, 0, 0}, {100, 0, 0});
  constexpr double dt = 1e-3;
  ContactBody& body = lumps.bodies[0];
  body.go_with({100, 0, 0});
  EXPECT_EQ(body.speed(), 0);
  body.forget_changes();
  body.end_step(dt);
  for (const Index cell : lumps.moving[0]->body().lattice.masses)
    lumps.moving[0]->place(cell, Vec3(dt * 100, 0, 1e-4), {100, 0, 0});
  body.refresh(0);
  EXPECT_NEAR(body.moved(), 1e-4, 1e-12);
  body.refresh(0);  // the same again is no step
  EXPECT_NEAR(body.moved(), 1e-4, 1e-12);
}

}  // namespace
}  // namespace palpate::physics
