// Two bodies that meet, as the paper shows and tells of them: what is measured here must be what it says in words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <bit>

#include "common/scene/load_scene.h"
#include "physics_node/world.h"

namespace palpate::physics {
namespace {

Scene scene_called(const std::string& name) { return load_scene(std::string(SCENES) + "/" + name + ".toml"); }

double broken_share(const MovingBody& body) {
  return static_cast<double>(body.breaks()) / static_cast<double>(body.body().lattice.n_elements());
}

Vec3 centre(const MovingBody& body) {
  Vec3 sum = Vec3::Zero();
  for (const Index cell : body.body().lattice.masses) sum += body.position(cell);
  return sum / static_cast<double>(body.body().lattice.n_masses());
}

Vec3 mean_velocity(const MovingBody& body) {
  Vec3 sum = Vec3::Zero();
  for (const Index cell : body.body().lattice.masses) sum += body.velocity(cell);
  return sum / static_cast<double>(body.body().lattice.n_masses());
}

/// Angle of the best rigid fit of the shape at rest [degrees].
double turned_by(const MovingBody& body) {
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
double height_of_edge(const MovingBody& body, double x) {
  double lowest = 1e9;
  for (const Index cell : body.body().lattice.masses) {
    const Vec3 rest = body.body().lattice.rest_position(cell);
    if (std::abs(rest.x() - x) < 0.012 && rest.z() < 0.012) lowest = std::min(lowest, body.position(cell).z());
  }
  return lowest;
}

/// Share of the elements that broke among those of masses for which `holds(rest position)`.
template <class Holds>
double broken_share_where(const MovingBody& body, const Holds& holds) {
  double broken = 0, all = 0;
  const Lattice& lattice = body.body().lattice;
  for (const Index cell : lattice.masses) {
    if (!holds(lattice.rest_position(cell))) continue;
    const Mask at_start = lattice.mask[static_cast<std::size_t>(cell)];
    all += std::popcount(at_start);
    broken += std::popcount(at_start) - std::popcount(body.mask(cell));
  }
  return all > 0 ? broken / all : 0;
}

void run(World& world, double seconds) {
  while (world.t() < seconds - 1e-9 && !world.has_stopped()) world.frame({});
  EXPECT_FALSE(world.has_stopped());
  EXPECT_LT(world.ledger().balance_error(), 0.01);
  EXPECT_EQ(world.report().restored, 0);
}

TEST(Collide, AOneSphereRunsThroughTheOther) {
  World world(scene_called("collide_a"));
  const MovingBody &target = world.body(0), &bullet = world.body(1);
  const double speed = mean_velocity(bullet).x();
  run(world, 0.08);
  const double kept = mean_velocity(bullet).x() / speed;
  fmt::print("broken: target {:.2f}, bullet {:.3f}; the bullet keeps {:.2f} of its speed and is {:.0f} mm beyond the target\n",
             broken_share(target), broken_share(bullet), kept, 1e3 * (centre(bullet) - centre(target)).x());
  EXPECT_GT(broken_share(target), 0.3);
  EXPECT_EQ(broken_share(bullet), 0);
  EXPECT_GT(kept, 0.6);
  EXPECT_GT((centre(bullet) - centre(target)).x(), 0.06) << "on the other side";
}

TEST(Collide, BBothSpheresAreDestroyed) {
  World world(scene_called("collide_b"));
  run(world, 0.15);
  for (std::size_t b = 0; b < 2; ++b) {
    const auto& masses = world.fragments(b)->masses();
    const double largest = *std::max_element(masses.begin(), masses.end()) /
                           static_cast<double>(world.body(b).body().lattice.n_masses());
    fmt::print("{}: broken {:.3f}, largest fragment {:.3f}\n", world.body(b).body().name, broken_share(world.body(b)), largest);
    EXPECT_GT(broken_share(world.body(b)), 0.8);
    EXPECT_LT(largest, 0.1);
  }
}

TEST(Collide, CTheFarCornerOfTheCubeLifts) {
  World world(scene_called("collide_c"));
  const MovingBody& cube = world.body(0);
  const double before = height_of_edge(cube, 0.05);
  double lift = 0, near_then = 0, turn = 0;
  while (world.t() < 0.25) {
    world.frame({});
    const double now = height_of_edge(cube, 0.05) - before;
    if (now > lift) lift = now, near_then = height_of_edge(cube, -0.05);
    turn = std::max(turn, turned_by(cube));
  }
  fmt::print("the far edge lifts {:.1f} mm while the near one is at {:.1f} mm; turned by {:.1f} degrees; broken {:.4f}\n",
             1e3 * lift, 1e3 * near_then, turn, broken_share(cube));
  EXPECT_GT(lift, 0.003);
  EXPECT_LT(near_then, lift);
  EXPECT_EQ(broken_share(cube), 0);
  EXPECT_LT(world.ledger().balance_error(), 0.01);
}

TEST(Collide, DTheHarderCubeCracksNearContactAndFloorAndTurnsALittle) {
  World world(scene_called("collide_d"));
  const MovingBody& cube = world.body(0);
  run(world, 0.15);
  const double contact = broken_share_where(cube, [](const Vec3& p) { return (p - Vec3(-0.05, 0, 0.1)).norm() < 0.045; });
  const double floor = broken_share_where(cube, [](const Vec3& p) { return p.z() < 0.02; });
  const double elsewhere = broken_share_where(cube, [](const Vec3& p) {
    return (p - Vec3(-0.05, 0, 0.1)).norm() >= 0.045 && p.z() >= 0.02;
  });
  const double turn = turned_by(cube);
  fmt::print("broken near the contact {:.3f}, near the floor {:.3f}, elsewhere {:.3f}; turned by {:.1f} degrees\n", contact,
             floor, elsewhere, turn);
  EXPECT_GT(contact, 2 * elsewhere);
  EXPECT_GT(floor, 1.2 * elsewhere);
  EXPECT_GT(turn, 0.3);
  EXPECT_LT(turn, 15);
}

}  // namespace
}  // namespace palpate::physics
