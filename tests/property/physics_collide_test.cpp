// Two bodies that meet, as the paper shows and tells of them: what is measured here must be what it says in words, and they may
// not go through each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <functional>

#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "physics_node/report/physics_summary.h"
#include "physics_node/world.h"

namespace palpate::physics {
namespace {

Scene scene_called(const std::string& name) { return load_scene(std::string(SCENES) + "/" + name + ".toml"); }

double broken_share(const BodyModel& body) {
  return static_cast<double>(body.breaks()) / static_cast<double>(body.body().lattice.n_elements());
}

Vec3 centre(const BodyModel& body) {
  Vec3 sum = Vec3::Zero();
  for (const Index cell : body.body().lattice.masses) sum += body.position(cell);
  return sum / static_cast<double>(body.body().lattice.n_masses());
}

Vec3 mean_velocity(const BodyModel& body) {
  Vec3 sum = Vec3::Zero();
  for (const Index cell : body.body().lattice.masses) sum += body.velocity(cell);
  return sum / static_cast<double>(body.body().lattice.n_masses());
}

/// Angle of the best rigid fit of the shape at rest [degrees].
double turned_by(const BodyModel& body) {
  const auto& masses = body.body().lattice.masses;
  Eigen::Matrix3Xd rest(3, masses.size()), now(3, masses.size());
  for (std::size_t n = 0; n < masses.size(); ++n) {
    rest.col(static_cast<Eigen::Index>(n)) = body.body().lattice.rest_position(masses[n]);
    now.col(static_cast<Eigen::Index>(n)) = body.position(masses[n]);
  }
  const Eigen::Matrix4d X = Eigen::umeyama(rest, now, false);
  return Eigen::AngleAxisd(Eigen::Matrix3d(X.topLeftCorner<3, 3>())).angle() * 180 / M_PI;
}

/// The lowest mass of the bottom edge at x, from where it is at rest: how high it is now [m].
double height_of_edge(const BodyModel& body, double x) {
  double lowest = 1e9;
  for (const Index cell : body.body().lattice.masses) {
    const Vec3 rest = body.body().lattice.rest_position(cell);
    if (std::abs(rest.x() - x) < 0.012 && rest.z() < 0.012)
      lowest = std::min(lowest, body.position(cell).z());
  }
  return lowest;
}

/// Share of the elements that broke among those of masses for which `holds(rest position)`.
template <class Holds>
double broken_share_where(const BodyModel& body, const Holds& holds) {
  double broken = 0, all = 0;
  const Lattice& lattice = body.body().lattice;
  for (const Index cell : lattice.masses) {
    if (!holds(lattice.rest_position(cell))) continue;
    const Mask at_start = lattice.mask[static_cast<std::size_t>(cell)];
    all += std::popcount(at_start);
    broken += std::popcount(at_start) - std::popcount(body.adjacency().live_elements(cell));
  }
  return all > 0 ? broken / all : 0;
}

/// As long as the scene says. Whatever else happens: no mass ends or ever is inside another body, and nothing is warned of.
void run(
    World& world, const std::function<void()>& after_frame = [] {}) {
  while (world.t() < world.scene().natural_seconds() - 1e-9 && !world.has_stopped()) {
    world.frame({});
    after_frame();
  }
  EXPECT_FALSE(world.has_stopped());
  EXPECT_LT(world.ledger().balance_error(), 0.01);
  EXPECT_EQ(world.report().restored, 0);
  const auto summary = physics_summary(world, nullptr, 1);
  for (const auto& [name, body] : summary.at("bodies").items()) {
    EXPECT_EQ(body.at("inside_others"), 0) << name;
    EXPECT_EQ(body.at("inside_others_max"), 0) << name;
  }
  EXPECT_TRUE(summary.at("warnings").empty()) << summary.at("warnings");
}

/// Share of the mass in the heaviest fragment.
double largest(const World& world, std::size_t b) {
  const auto& masses = world.fragments(b)->masses();
  return *std::max_element(masses.begin(), masses.end()) /
         static_cast<double>(world.body(b).body().lattice.n_masses());
}

TEST(Collide, AOneSphereRunsThroughTheOther) {
  World world(scene_called("collide_a"));
  const BodyModel &target = world.body(0), &bullet = world.body(1);
  const double speed = mean_velocity(bullet).x();
  run(world);
  const double kept = mean_velocity(bullet).x() / speed;
  fmt::print(
      "broken: target {:.2f}, bullet {:.3f}; the bullet keeps {:.2f} of its speed and is {:.0f} mm beyond "
      "the target\n",
      broken_share(target), broken_share(bullet), kept, 1e3 * (centre(bullet) - centre(target)).x());
  EXPECT_GT(broken_share(target), 0.3);
  EXPECT_EQ(broken_share(bullet), 0);
  EXPECT_GT(kept, 0.6);
  EXPECT_GT((centre(bullet) - centre(target)).x(), 0.06) << "on the other side";
}

TEST(Collide, BBothSpheresAreDestroyed) {
  World world(scene_called("collide_b"));
  run(world);
  for (std::size_t b = 0; b < 2; ++b) {
    fmt::print("{}: broken {:.3f}, largest fragment {:.3f}\n", world.body(b).body().name,
               broken_share(world.body(b)), largest(world, b));
    EXPECT_GT(broken_share(world.body(b)), 0.8);
    EXPECT_LT(largest(world, b), 0.1);
  }
}

/// Where the ball of case (c) and (d) meets the cube: its upper edge on the side of the ball.
const Vec3 struck(-0.05, 0, 0.1);

TEST(Collide, CBothAreDestroyedWhereTheyTouchAndTheFarEdgeOfTheCubeLifts) {
  World world(scene_called("collide_c"));
  const BodyModel &cube = world.body(0), &ball = world.body(1);
  const double before = height_of_edge(cube, 0.05);
  double lift = 0, near_then = 0, turn = 0;
  run(world, [&] {
    const double now = height_of_edge(cube, 0.05) - before;
    if (now > lift) lift = now, near_then = height_of_edge(cube, -0.05) - before;
    turn = std::max(turn, turned_by(cube));
  });
  const auto near = [](const Vec3& p) { return (p - struck).norm() < 0.045; };
  const double contact = broken_share_where(cube, near);
  const double elsewhere = broken_share_where(cube, [&](const Vec3& p) { return !near(p); });
  const Vec3 middle(-0.05, 0, 0.15);  // of the ball
  const double under = broken_share_where(ball, [&](const Vec3& p) { return p.z() < middle.z() - 0.02; });
  const double over = broken_share_where(ball, [&](const Vec3& p) { return p.z() > middle.z() + 0.02; });
  fmt::print(
      "broken: cube {:.3f}, near the contact {:.3f}, elsewhere {:.3f}; ball {:.3f}, below {:.3f}, above "
      "{:.3f}\n",
      broken_share(cube), contact, elsewhere, broken_share(ball), under, over);
  fmt::print(
      "the far edge lifts {:.1f} mm while the near one has risen {:.1f} mm; turned by {:.1f} degrees\n",
      1e3 * lift, 1e3 * near_then, turn);
  EXPECT_GT(contact, 0.05);
  EXPECT_GT(contact, 2 * elsewhere);
  EXPECT_GT(under, 0.05);
  EXPECT_GT(under, 2 * over);
  EXPECT_GT(largest(world, 0), 0.95) << "the cube tips as one body";
  EXPECT_GT(lift, 0.03);
  EXPECT_LT(near_then, 0.5 * lift);
  EXPECT_GT(turn, 15);
}

TEST(Collide, DTheHarderCubeCracksNearContactAndFloorAndTurnsALittle) {
  World world(scene_called("collide_d"));
  const BodyModel& cube = world.body(0);
  double turn = 0;
  run(world, [&] { turn = std::max(turn, turned_by(cube)); });
  const double contact = broken_share_where(cube, [](const Vec3& p) { return (p - struck).norm() < 0.045; });
  const double floor = broken_share_where(cube, [](const Vec3& p) { return p.z() < 0.02; });
  const double elsewhere =
      broken_share_where(cube, [](const Vec3& p) { return (p - struck).norm() >= 0.045 && p.z() >= 0.02; });
  fmt::print(
      "broken near the contact {:.3f}, near the floor {:.3f}, elsewhere {:.3f}; turned by {:.1f} degrees\n",
      contact, floor, elsewhere, turn);
  EXPECT_GT(contact, 0.05);
  EXPECT_GT(contact, 2 * elsewhere);
  EXPECT_GT(floor, 1.2 * elsewhere);
  EXPECT_GT(largest(world, 0), 0.95) << "it cracks and stays one";
  EXPECT_GT(turn, 0.3);
  EXPECT_LT(turn, 15);
}

/// The paper's contact, of masses with masses, on the same scene: what the measure is for.
TEST(Collide, ByThePapersContactTheBallEndsInsideTheCubeAndThatIsSaid) {
  World world(load_scene(std::string(SCENES) + "/collide_c.toml",
                         {"contact.distance=\"paper\"", "body.ball.velocity_m_per_s=[0.0,0.0,-0.6]",
                          "material.soft.yield_ratio=1.4", "material.soft.break_ratio=2.0"}));
  while (world.t() < 0.15) world.frame({});
  const auto summary = physics_summary(world, nullptr, 1);
  EXPECT_GT(summary.at("bodies").at("ball").at("inside_others").get<int>(), 50);
  ASSERT_FALSE(summary.at("warnings").empty());
  EXPECT_NE(summary.at("warnings")[0].get<std::string>().find("bodies go into each other"),
            std::string::npos);
}

}  // namespace
}  // namespace palpate::physics
